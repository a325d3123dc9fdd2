// Jolt Physics: code in C++ and in JavaScript (npm: jolt-physics) that builds its settings.

#include <algorithm>

#include <fmt/format.h>

#include "elastic/stable_step.hpp"
#include "report/export/arrays.hpp"
#include "report/export/draft.hpp"
#include "report/export/substep_window.hpp"

namespace springlod::report {

namespace {

constexpr const char* kAxes = "SI units, y is up: the asset's (x, y, z) is (x, z, -y) here.";

std::string comment(const ExportedModel& body, const std::vector<std::string>& lines) {
  std::string text =
      fmt::format("// {} for Jolt Physics, by {}.\n// {}\n", body.name, body.origin, kAxes);
  for (const std::string& line : lines) text += fmt::format("// {}\n", line);
  return text;
}

constexpr const char* kCppBuild = R"(
/// The nodes and springs, to be shared by all bodies of this kind. Nodes of `held` do not move.
/// `substep`: step over iterations [s]. Edges are stiffer than the springs by what Jolt softens
/// them in a substep.
inline JPH::Ref<JPH::SoftBodySharedSettings> shared_settings(
    const std::vector<std::uint32_t>& held = {}, float substep = kStep / kIterations) {
  JPH::Ref<JPH::SoftBodySharedSettings> shared = new JPH::SoftBodySharedSettings;
  for (std::uint32_t n = 0; n < kNodes; ++n)
    shared->mVertices.emplace_back(
        JPH::Float3(kPosition[3 * n], kPosition[3 * n + 1], kPosition[3 * n + 2]),
        JPH::Float3(0, 0, 0), 1 / kMass[n]);
  for (const std::uint32_t n : held) shared->mVertices[n].mInvMass = 0;
  for (std::uint32_t s = 0; s < kSprings; ++s) {
    JPH::SoftBodySharedSettings::Edge edge(kEnds[2 * s], kEnds[2 * s + 1]);
    const float mobility =
        shared->mVertices[kEnds[2 * s]].mInvMass + shared->mVertices[kEnds[2 * s + 1]].mInvMass;
    edge.mCompliance = std::max(1 / kStiffness[s] - mobility * substep * substep / 2, 0.0F);
    edge.mRestLength = kRestLength[s];
    shared->mEdgeConstraints.push_back(edge);
  }
  shared->Optimize();
  return shared;
}

/// A body with its middle at `position`. Update the physics system with kStep and one collision
/// step; the iterations of a soft body are its substeps.
inline JPH::SoftBodyCreationSettings creation_settings(
    const JPH::SoftBodySharedSettings* shared, JPH::ObjectLayer layer,
    JPH::RVec3Arg position = JPH::RVec3(kCenter[0], kCenter[1], kCenter[2])) {
  JPH::SoftBodyCreationSettings settings(shared, position, JPH::Quat::sIdentity(), layer);
  settings.mNumIterations = kIterations;
  settings.mLinearDamping = 0;  // it would also brake the flight of the body
  return settings;
}
)";

std::string cpp_file(const ExportedModel& body, const SingleBody& single, int iterations,
                     const std::vector<std::string>& lines) {
  return comment(body, lines) +
         fmt::format(
             "#pragma once\n\n#include <algorithm>\n#include <array>\n#include <cstdint>\n#include "
             "<vector>\n\n"
             "#include <Jolt/Jolt.h>\n\n"
             "#include <Jolt/Physics/SoftBody/SoftBodyCreationSettings.h>\n"
             "#include <Jolt/Physics/SoftBody/SoftBodySharedSettings.h>\n\n"
             "namespace {} {{\n\n"
             "inline constexpr float kStep = 1.0F / {};  ///< [s]\n"
             "inline constexpr unsigned kIterations = {};\n",
             body.name, FrameSubsteps::kFrames, iterations) +
         cpp_arrays(single) + kCppBuild + fmt::format("\n}}  // namespace {}\n", body.name);
}

// What follows the data in the JavaScript file.
constexpr const char* kJavaScriptBuild = R"(
/** JPH::SoftBodySharedSettings, to be shared by all bodies of this kind. `Jolt` is the module of
 *  jolt-physics; nodes of `held` do not move; `substep`: step over iterations [s]. Edges are
 *  stiffer than the springs by what Jolt softens them in a substep. */
export function sharedSettings(Jolt, held = [], substep = settings.step / settings.iterations) {
  const shared = new Jolt.SoftBodySharedSettings();
  const fixed = new Set(held);
  const vertex = new Jolt.SoftBodySharedSettingsVertex();
  const inverse = nodes.mass.map((mass, n) => (fixed.has(n) ? 0 : 1 / mass));
  inverse.forEach((inverseMass, n) => {
    [vertex.mPosition.x, vertex.mPosition.y, vertex.mPosition.z] =
      nodes.position.slice(3 * n, 3 * n + 3);
    vertex.mInvMass = inverseMass;
    shared.mVertices.push_back(vertex);
  });
  const edge = new Jolt.SoftBodySharedSettingsEdge(0, 0, 0);
  springs.stiffness.forEach((stiffness, s) => {
    const [a, b] = springs.ends.slice(2 * s, 2 * s + 2);
    edge.set_mVertex(0, a);
    edge.set_mVertex(1, b);
    edge.mRestLength = springs.restLength[s];
    edge.mCompliance = Math.max(1 / stiffness - (inverse[a] + inverse[b]) * substep ** 2 / 2, 0);
    shared.mEdgeConstraints.push_back(edge);
  });
  Jolt.destroy(vertex);
  Jolt.destroy(edge);
  shared.Optimize();
  return shared;
}

/** JPH::SoftBodyCreationSettings of a body with its middle at `position`. Step the world with
 *  settings.step and one collision step; the iterations of a soft body are its substeps. */
export function creationSettings(Jolt, shared, layer, position = center) {
  const at = new Jolt.RVec3(...position);
  const upright = new Jolt.Quat(0, 0, 0, 1);
  const made = new Jolt.SoftBodyCreationSettings(shared, at, upright, layer);
  made.mNumIterations = settings.iterations;
  made.mLinearDamping = 0; // it would also brake the flight of the body
  Jolt.destroy(at);
  Jolt.destroy(upright);
  return made;
}

/** Positions of the nodes of a body in the world, three numbers each [m]. */
export function nodePositions(Jolt, body) {
  const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
  const vertices = motion.GetVertices();
  const at = body.GetPosition();
  const middle = [at.GetX(), at.GetY(), at.GetZ()];
  const positions = new Float64Array(3 * nodes.mass.length);
  for (let n = 0; n < nodes.mass.length; ++n) {
    const p = vertices.at(n).mPosition;
    positions.set([middle[0] + p.GetX(), middle[1] + p.GetY(), middle[2] + p.GetZ()], 3 * n);
  }
  return positions;
}

/** Positions of the skin's vertices, three numbers each, from those of the nodes. */
export function skinPositions(positions) {
  const vertices = skin.start.length - 1;
  const placed = new Float32Array(3 * vertices);
  for (let v = 0; v < vertices; ++v)
    for (let i = skin.start[v]; i < skin.start[v + 1]; ++i)
      for (let axis = 0; axis < 3; ++axis)
        placed[3 * v + axis] += skin.weight[i] * positions[3 * skin.node[i] + axis];
  return placed;
}
)";

std::string javascript_file(const ExportedModel& body, const SingleBody& single,
                            const SubstepWindow& window, const std::vector<std::string>& lines) {
  std::string text = comment(body, lines);
  text += fmt::format(
      "export const name = \"{}\";\n"
      "/** Step of the world [s]; iterations of the body; range of substeps a second within {:.0f} "
      "%,\n"
      " *  [0, 0] if there is none; estimated relative error at rest with these settings. */\n"
      "export const settings = {{ step: 1 / {}, iterations: {}, substepsWithin: [{:.0f}, {:.0f}], "
      "error: {:.2g} }};\n"
      "/** Middle of the body at rest [m], to which nodes.position is relative. */\n"
      "export const center = [{}];\n",
      body.name, 100 * kWindowError, FrameSubsteps::kFrames, frame_substeps(window).per_frame,
      window.from, window.to, window.error, list(single.center, false));
  text += fmt::format(
      "/** Three numbers a node [m]; [kg]. */\n"
      "export const nodes = {{\nposition: [\n{}],\nmass: [\n{}],\n}};\n",
      list(single.position, false), list(single.mass, false));
  text += fmt::format(
      "/** Two nodes a spring; [m]; [N/m]. */\nexport const springs = {{\n"
      "ends: [\n{}],\nrestLength: [\n{}],\nstiffness: [\n{}],\n}};\n",
      list(single.ends), list(single.rest_length, false), list(single.stiffness, false));
  if (single.has_skin())
    text += fmt::format(
        "/** Vertex v is the sum of weight[i] times node[i] over start[v] <= i < "
        "start[v + 1]; three\n *  vertices a triangle. */\nexport const skin = {{\n"
        "start: [\n{}],\nnode: [\n{}],\nweight: [\n{}],\ntriangles: [\n{}],\n}};\n",
        list(single.skin_start), list(single.skin_node), list(single.skin_weight, false),
        list(single.triangles));
  else
    text +=
        "/** The asset has no surface. */\nexport const skin = "
        "{ start: [0], node: [], weight: [], triangles: [] };\n";
  return text + kJavaScriptBuild;
}

std::vector<std::string> losses(const ExportedModel& body) {
  std::vector<std::string> lost = lost_beside_springs(body.model);
  if (elastic::largest_damping_time(body.model) > 0)
    lost.push_back("damping of springs: Jolt has none, but its solver damps vibrations by itself");
  lost.push_back("double precision: Jolt keeps the nodes of soft bodies as single");
  lost.push_back("faces: Jolt's rays and shapes meet the nodes only");
  return lost;
}

}  // namespace

ExportDraft draft_jolt(const ExportedModel& body) {
  const SingleBody single = single_body(body);
  const SubstepWindow window = substep_window(body.model, body.gravity.norm(), single.extent);
  const FrameSubsteps substeps = frame_substeps(window);
  ExportDraft draft;
  draft.settings = {
      fmt::format("step 1/{} s with {} iterations (mNumIterations): {} substeps a "
                  "second; mLinearDamping 0",
                  FrameSubsteps::kFrames, substeps.per_frame, substeps.per_second())};
  draft.settings.push_back(
      "edges are stiffer than the springs by what Jolt softens them in a substep: with another "
      "substep, give it to the function that makes the shared settings");
  for (std::string& line : describe_window(window)) draft.settings.push_back(std::move(line));
  draft.losses = losses(body);
  std::vector<std::string> lines = draft.settings;
  for (const std::string& loss : draft.losses) lines.push_back("Not here: " + loss);
  draft.files = {{".hpp", cpp_file(body, single, substeps.per_frame, lines)},
                 {".mjs", javascript_file(body, single, window, lines)}};
  return draft;
}

}  // namespace springlod::report
