// The surface of a moving body as glTF: skinned on the nodes, or with a morph target a frame.

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/asset/glb.hpp"
#include "model/asset/gltf_builder.hpp"
#include "model/asset/gltf_surface.hpp"
#include "model/creases.hpp"
#include "report/export/motion_files.hpp"
#include "report/export/skinning.hpp"

namespace springlod::report {

namespace {

using nlohmann::json;

// Joints are numbered in 16 bits.
constexpr std::size_t kMostJoints = 65536;

using Joints = std::array<std::uint16_t, 4>;
using Float4 = std::array<float, 4>;

// A primitive for each mesh part, with these attributes.
json primitives_of(GltfBuilder& gltf, const ExportedModel& body, const SplitSurface& shaded,
                   const json& attributes) {
  return part_primitives(gltf, body.surface->parts, body.model.materials, attributes,
                         add_triangles(gltf, shaded.triangles));
}

std::vector<double> times_of(const std::vector<sim::Frame>& frames) {
  std::vector<double> times;
  for (const sim::Frame& frame : frames) times.push_back(frame.time - frames.front().time);
  return times;
}

// JOINTS_n and WEIGHTS_n, four influences each.
void add_influences(GltfBuilder& gltf, const Skinning& skinning, const SplitSurface& shaded,
                    json& attributes) {
  for (std::uint32_t first = 0, n = 0; first < skinning.influences; first += 4, ++n) {
    std::vector<Joints> joints(shaded.source.size());
    std::vector<Float4> weights(shaded.source.size());
    const std::uint32_t count = std::min(4U, skinning.influences - first);
    for (std::size_t v = 0; v < shaded.source.size(); ++v)
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t entry = std::size_t{shaded.source[v]} * skinning.influences + first + i;
        joints[v][i] = static_cast<std::uint16_t>(skinning.joint[entry]);
        weights[v][i] = skinning.weight[entry];
      }
    attributes[fmt::format("JOINTS_{}", n)] = gltf.add_array(joints, gltf::Target::vertices);
    attributes[fmt::format("WEIGHTS_{}", n)] = gltf.add_array(weights, gltf::Target::vertices);
  }
}

// Of one joint, the same side of the quaternions' sphere all along: players interpolate.
std::vector<Float4> rotation_track(const std::vector<NodePoses>& poses, std::uint32_t node) {
  std::vector<Float4> track;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  for (const NodePoses& pose : poses) {
    Eigen::Quaterniond q = pose.rotation[node];
    if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
    last = q;
    const Eigen::Quaternionf f = q.cast<float>().normalized();
    track.push_back({f.x(), f.y(), f.z(), f.w()});
  }
  return track;
}

std::vector<Vec3> position_track(const std::vector<NodePoses>& poses, std::uint32_t node) {
  std::vector<Vec3> track;
  for (const NodePoses& pose : poses) track.push_back(pose.position[node]);
  return track;
}

void add_channel(json& animation, std::size_t times, std::size_t values, std::size_t node,
                 const char* path) {
  animation["samplers"].push_back({{"input", times}, {"output", values}});
  const std::size_t sampler = animation["samplers"].size() - 1;
  animation["channels"].push_back(
      {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

// Joints below the node `root`, their tracks, and the skin; returns its number.
std::size_t add_skin(GltfBuilder& gltf, const ExportedMotion& motion, const Skinning& skinning,
                     const std::vector<NodePoses>& poses, std::size_t root) {
  const std::size_t times = gltf.add_times(times_of(motion.frames));
  json animation{{"name", motion.body.name}};
  std::vector<std::array<float, 16>> inverse_bind;
  std::vector<std::size_t> joints;
  for (const std::uint32_t node : skinning.node) {
    const Eigen::Vector3f rest = motion.body.model.rest[node].cast<float>();
    inverse_bind.push_back(
        {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -rest.x(), -rest.y(), -rest.z(), 1});
    joints.push_back(gltf.append("nodes", {{"name", fmt::format("node {}", node)},
                                           {"translation", {rest.x(), rest.y(), rest.z()}}}));
    add_channel(animation, times, gltf.add_array(position_track(poses, node)), joints.back(),
                "translation");
    add_channel(animation, times, gltf.add_array(rotation_track(poses, node)), joints.back(),
                "rotation");
  }
  gltf.document()["nodes"][root]["children"] = joints;
  gltf.append("animations", std::move(animation));
  return gltf.append("skins", {{"joints", joints},
                               {"skeleton", root},
                               {"inverseBindMatrices", gltf.add_array(inverse_bind)}});
}

std::string percent_of_size(double length, const ExportedModel& body) {
  return fmt::format("{:.2g} %", 100 * length / bounds(*body.surface).diagonal().norm());
}

void finish(GltfBuilder& gltf, const std::vector<std::size_t>& roots, MotionFiles& files) {
  gltf.set_scene(roots);
  const std::size_t bytes = gltf.buffer().bytes().size();
  if (bytes > kLargestGlbBuffer)
    throw InputError(fmt::format(
        "{} bytes do not fit into a .glb file (4 GB); take fewer frames or a coarser level",
        bytes));
  std::ostringstream out;
  write_glb(out, gltf.pieces());
  files.write(".glb", std::move(out).str());
  files.report.losses.push_back("springs and masses: what moves is the surface");
}

}  // namespace

void write_skinned_glb(const ExportedMotion& motion, const MotionOptions& options,
                       MotionFiles& files) {
  require_surface(motion.body, "glb");
  std::vector<NodePoses> poses;
  for (const sim::Frame& frame : motion.frames)
    poses.push_back(node_poses(motion.body.model, frame.x));
  const Skinning skinning = fit_skinning(motion, poses, options.influences);
  if (skinning.node.size() > kMostJoints)
    throw InputError(
        fmt::format("export_motion: {} nodes move the surface, a glb numbers {} joints; take a "
                    "coarser level or glb_morph",
                    skinning.node.size(), kMostJoints));
  GltfBuilder gltf;
  const SplitSurface shaded = split_at_creases(*motion.body.surface);
  const std::vector<Vec3> points = surface_points(motion.body);
  json attributes{
      {"POSITION", gltf.add_positions(drawn_positions(shaded, points))},
      {"NORMAL", gltf.add_array(drawn_normals(shaded, points), gltf::Target::vertices)}};
  add_influences(gltf, skinning, shaded, attributes);
  const std::size_t mesh =
      gltf.append("meshes", {{"name", motion.body.name},
                             {"primitives", primitives_of(gltf, motion.body, shaded, attributes)}});
  const std::size_t root = gltf.append("nodes", z_up_node());
  const std::size_t skin = add_skin(gltf, motion, skinning, poses, root);
  // A skinned mesh stands where its joints do, so its node is a root of its own.
  const std::size_t body =
      gltf.append("nodes", {{"name", motion.body.name}, {"mesh", mesh}, {"skin", skin}});
  finish(gltf, {root, body}, files);
  files.report.settings.push_back(fmt::format(
      "{} joints, at most {} a vertex: the skin is {} of the body's size away from the surface on "
      "average (root mean square), {} at most",
      skinning.node.size(), options.influences, percent_of_size(skinning.mean_error, motion.body),
      percent_of_size(skinning.largest_error, motion.body)));
}

void write_morphed_glb(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  require_surface(motion.body, "glb_morph");
  GltfBuilder gltf;
  const SplitSurface shaded = split_at_creases(*motion.body.surface);
  const std::vector<Vec3> rest = surface_points(motion.body);
  const std::vector<Vec3> points = drawn_positions(shaded, rest),
                          normals = drawn_normals(shaded, rest);
  json attributes{{"POSITION", gltf.add_positions(points)},
                  {"NORMAL", gltf.add_array(normals, gltf::Target::vertices)}};
  json targets = json::array();
  for (const sim::Frame& frame : motion.frames) {
    const std::vector<Vec3> surface = surface_at(motion.body, frame.x);
    std::vector<Vec3> moved = drawn_positions(shaded, surface),
                      turned = drawn_normals(shaded, surface);
    for (std::size_t v = 0; v < moved.size(); ++v) {
      moved[v] -= points[v];
      turned[v] -= normals[v];
    }
    targets.push_back({{"POSITION", gltf.add_positions(moved)},
                       {"NORMAL", gltf.add_array(turned, gltf::Target::vertices)}});
  }
  json primitives = primitives_of(gltf, motion.body, shaded, attributes);
  for (json& primitive : primitives) primitive["targets"] = targets;
  const std::size_t count = motion.frames.size();
  std::vector<float> weights(count, 0.0F);
  const std::size_t mesh = gltf.append(
      "meshes",
      {{"name", motion.body.name}, {"primitives", std::move(primitives)}, {"weights", weights}});
  const std::size_t root = gltf.append("nodes", z_up_node());
  const std::size_t body = gltf.append("nodes", {{"name", motion.body.name}, {"mesh", mesh}});
  gltf.document()["nodes"][root]["children"] = {body};
  std::vector<float> track(count * count, 0.0F);
  for (std::size_t f = 0; f < count; ++f) track[f * count + f] = 1.0F;
  json animation{{"name", motion.body.name}};
  add_channel(animation, gltf.add_times(times_of(motion.frames)), gltf.add_array(track), body,
              "weights");
  gltf.append("animations", std::move(animation));
  finish(gltf, {root}, files);
  files.report.settings.push_back(
      fmt::format("{} morph targets, one a frame, of which a player blends two", count));
}

}  // namespace springlod::report
