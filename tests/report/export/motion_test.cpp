#include "report/export/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "report/export/skinning.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/temporary_folder.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;
using springlod::Binding;
using springlod::InputError;
using springlod::LodAsset;
using springlod::MassSpringModel;
using springlod::Mat3;
using springlod::read_file;
using springlod::Vec3;
using springlod::report::export_motion;
using springlod::report::ExportedModel;
using springlod::report::ExportedMotion;
using springlod::report::ExportReport;
using springlod::report::fit_skinning;
using springlod::report::MotionFormat;
using springlod::report::node_poses;
using springlod::report::NodePoses;
using springlod::report::Skinning;
using springlod::sim::Frame;
using springlod::test::sample_asset;
using springlod::test::TemporaryFolder;

namespace {

// The base of a sample and its surface.
struct Body {
  LodAsset asset = sample_asset();
  const MassSpringModel& model() const { return asset.chain.levels.front().model; }
  ExportedModel exported() const {
    return {.model = model(),
            .surface = &asset.surface,
            .surface_of_nodes = asset.surface_of_base,
            .name = "sample"};
  }
};

Mat3 turn(double angle) {
  return Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
}

std::vector<Frame> turning(const MassSpringModel& model, int count) {
  std::vector<Frame> frames;
  for (int f = 0; f < count; ++f) {
    Frame frame{0.1 * f, {}};
    for (const Vec3& p : model.rest) frame.x.push_back(turn(0.4 * f) * p + Vec3(0.3 * f, 0, 1));
    frames.push_back(frame);
  }
  return frames;
}

// Bent about y: a bar along z whose upper end has turned by `angle`.
std::vector<Frame> bending(const MassSpringModel& model, int count) {
  double height = 0;
  for (const Vec3& p : model.rest) height = std::max(height, p.z());
  std::vector<Frame> frames;
  for (int f = 0; f < count; ++f) {
    const double angle = 1.2 * f / count;
    Frame frame{0.1 * f, {}};
    for (const Vec3& p : model.rest) {
      if (angle == 0) {
        frame.x.push_back(p);
        continue;
      }
      const double radius = height / angle, along = angle * p.z() / height;
      frame.x.emplace_back(radius - (radius - p.x()) * std::cos(along), p.y(),
                           (radius - p.x()) * std::sin(along));
    }
    frames.push_back(frame);
  }
  return frames;
}

std::vector<NodePoses> poses_of(const ExportedMotion& motion) {
  std::vector<NodePoses> poses;
  for (const Frame& frame : motion.frames) poses.push_back(node_poses(motion.body.model, frame.x));
  return poses;
}

template <class T>
T number_at(const std::string& bytes, std::size_t offset, bool swapped = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, bytes.data() + offset, sizeof(T));
  if (swapped) std::reverse(raw, raw + sizeof(T));
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

json document_of(const std::string& glb) {
  const auto length = number_at<std::uint32_t>(glb, 12);
  return json::parse(glb.substr(20, length));
}

}  // namespace

TEST_CASE("The poses of the nodes of a turned body have its rotation") {
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 5);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const NodePoses poses = node_poses(body.model(), frames[f].x);
    for (const Eigen::Quaterniond& rotation : poses.rotation)
      REQUIRE((rotation.toRotationMatrix() - turn(0.4 * static_cast<double>(f))).norm() < 1e-12);
  }
}

TEST_CASE("A single node turns not at all, and a mirrored body is not turned inside out") {
  MassSpringModel one;
  one.rest = {{1, 2, 3}};
  one.mass = {1};
  const NodePoses still = node_poses(one, {{4, 5, 6}});
  CHECK(still.position.front() == Vec3(4, 5, 6));
  CHECK(still.rotation.front().toRotationMatrix().determinant() == Approx(1));
  const Body body;
  std::vector<Vec3> mirrored = body.model().rest;
  for (Vec3& p : mirrored) p.x() = -p.x();
  for (const Eigen::Quaterniond& rotation : node_poses(body.model(), mirrored).rotation)
    REQUIRE(rotation.toRotationMatrix().determinant() == Approx(1));
}

TEST_CASE("The skin of a body that moves rigidly is exact") {
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 7);
  const ExportedMotion motion{body.exported(), frames};
  const Skinning skin = fit_skinning(motion, poses_of(motion), 4);
  CHECK(skin.largest_error < 1e-6);
  CHECK(skin.mean_error <= skin.largest_error);
}

TEST_CASE("Skinning weights are not negative and add up to 1, and more joints follow better") {
  const Body body;
  const std::vector<Frame> frames = bending(body.model(), 9);
  const ExportedMotion motion{body.exported(), frames};
  const std::vector<NodePoses> poses = poses_of(motion);
  double last = 1;
  for (const std::uint32_t influences : {1U, 2U, 4U, 8U}) {
    CAPTURE(influences);
    const Skinning skin = fit_skinning(motion, poses, influences);
    const std::size_t vertices = body.asset.surface.positions.size();
    REQUIRE(skin.weight.size() == vertices * influences);
    for (std::size_t v = 0; v < vertices; ++v) {
      double sum = 0;
      for (std::size_t e = v * influences; e < (v + 1) * influences; ++e) {
        REQUIRE(skin.weight[e] >= 0);
        REQUIRE(skin.joint[e] < skin.node.size());
        sum += static_cast<double>(skin.weight[e]);
      }
      REQUIRE(sum == Approx(1).margin(1e-6));
    }
    CHECK(skin.mean_error <= last * (1 + 1e-9));
    last = skin.mean_error;
  }
  CHECK(last < 0.01 * bounds(body.asset.surface).diagonal().norm());
}

TEST_CASE("A skinned glb has two tracks a joint, a morphed one a target a frame") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = bending(body.model(), 6);
  const ExportedMotion motion{body.exported(), frames};
  const ExportReport skinned =
      export_motion(motion, scratch / "skin.glb", {.format = MotionFormat::glb});
  const json skin = document_of(read_file(skinned.files.front()));
  const std::size_t joints = skin.at("skins").at(0).at("joints").size();
  CHECK(joints > 0);
  CHECK(skin.at("animations").at(0).at("channels").size() == 2 * joints);
  const json times =
      skin.at("accessors")
          .at(skin.at("animations").at(0).at("samplers").at(0).at("input").get<std::size_t>());
  CHECK(times.at("count") == 6);
  CHECK(times.at("max").at(0).get<double>() == Approx(0.5));
  CHECK_THAT(skinned.settings.at(0), Contains("joints, at most 4 a vertex"));
  CHECK_FALSE(skin.at("meshes").at(0).at("primitives").at(0).at("attributes").contains("JOINTS_1"));

  const ExportReport wide =
      export_motion(motion, scratch / "wide", {.format = MotionFormat::glb, .influences = 8});
  CHECK(wide.files.front() == scratch / "wide.glb");
  const json eight = document_of(read_file(wide.files.front()));
  CHECK(eight.at("meshes").at(0).at("primitives").at(0).at("attributes").contains("WEIGHTS_1"));

  const ExportReport morphed =
      export_motion(motion, scratch / "morph.glb", {.format = MotionFormat::glb_morph});
  const json morph = document_of(read_file(morphed.files.front()));
  CHECK(morph.at("meshes").at(0).at("primitives").at(0).at("targets").size() == 6);
  CHECK(morph.at("meshes").at(0).at("weights").size() == 6);
}

TEST_CASE("Mesh parts of one material share it in a glb, as they do in an asset") {
  const TemporaryFolder scratch;
  Body body;
  const std::vector<Frame> frames = bending(body.model(), 2);
  const auto materials_of_parts = [&](const char* second) {
    body.asset.surface.parts.at(1).material = second;
    const ExportedMotion motion{body.exported(), frames};
    const ExportReport report =
        export_motion(motion, scratch / "motion.glb", {.format = MotionFormat::glb_morph});
    const json document = document_of(read_file(report.files.front()));
    std::vector<std::size_t> numbers{document.at("materials").size()};
    for (const json& primitive : document.at("meshes").at(0).at("primitives"))
      numbers.push_back(primitive.at("material"));
    return numbers;
  };
  CHECK(materials_of_parts("steel") == std::vector<std::size_t>{1, 0, 0});
  CHECK(materials_of_parts("rubber") == std::vector<std::size_t>{2, 0, 1});
}

TEST_CASE("Point caches hold every vertex of every frame, in single precision") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 4);
  const ExportedMotion motion{body.exported(), frames};
  const std::size_t vertices = body.asset.surface.positions.size();
  const std::string pc2 = read_file(
      export_motion(motion, scratch / "a.pc2", {.format = MotionFormat::pc2}).files.front());
  REQUIRE(pc2.size() == 32 + 4 * 3 * vertices * 4);
  CHECK(pc2.substr(0, 12) == std::string("POINTCACHE2\0", 12));
  CHECK(number_at<std::int32_t>(pc2, 16) == static_cast<int>(vertices));
  CHECK(number_at<std::int32_t>(pc2, 28) == 4);
  const std::string mdd = read_file(
      export_motion(motion, scratch / "a.mdd", {.format = MotionFormat::mdd}).files.front());
  REQUIRE(mdd.size() == 8 + 4 * 4 + 4 * 3 * vertices * 4);
  CHECK(number_at<std::int32_t>(mdd, 0, true) == 4);
  CHECK(number_at<std::int32_t>(mdd, 4, true) == static_cast<int>(vertices));
  CHECK(number_at<float>(mdd, 8 + 4 * 2, true) == 0.2F);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::vector<Vec3> surface = interpolate(body.asset.surface_of_base, frames[f].x);
    for (std::size_t v = 0; v < vertices; ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t entry = 4 * (3 * (f * vertices + v) + axis);
        const auto expected = static_cast<float>(surface[v][static_cast<Eigen::Index>(axis)]);
        REQUIRE(number_at<float>(pc2, 32 + entry) == expected);
        REQUIRE(number_at<float>(mdd, 8 + 4 * 4 + entry, true) == expected);
      }
  }
  CHECK(std::filesystem::exists(scratch / "a.obj"));
}

TEST_CASE("A VTK sequence lists its files with their times, the collection first in the report") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 3);
  const ExportReport report =
      export_motion({body.exported(), frames}, scratch / "run.pvd", {.format = MotionFormat::vtu});
  REQUIRE(report.files.size() == 7);
  CHECK(report.files.front() == scratch / "run.pvd");
  const std::string list = read_file(report.files.front());
  for (std::size_t f = 1; f < report.files.size(); ++f) {
    CHECK_THAT(list, Contains(report.files[f].filename().string()));
    CHECK(std::filesystem::exists(report.files[f]));
  }
  CHECK_THAT(list, Contains("timestep=\"0.2\""));
}

TEST_CASE("A motion is resampled at another frame rate, its last frame included") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 4);  // 0.3 s
  const ExportReport report = export_motion({body.exported(), frames}, scratch / "slow.obj",
                                            {.format = MotionFormat::obj, .frame_rate = 20});
  REQUIRE(report.files.size() == 7);
  CHECK(report.files.back() == scratch / "slow_0006.obj");
}

TEST_CASE("Formats of surfaces refuse a body without one, and one without frames is refused") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = turning(body.model(), 2);
  const ExportedModel bare{.model = body.model()};
  for (const MotionFormat format : {MotionFormat::glb, MotionFormat::glb_morph, MotionFormat::pc2,
                                    MotionFormat::mdd, MotionFormat::obj})
    CHECK_THROWS_WITH(export_motion({bare, frames}, scratch / "bare", {.format = format}),
                      Contains("has no surface"));
  CHECK(
      export_motion({bare, frames}, scratch / "bare", {.format = MotionFormat::vtu}).files.size() ==
      3);
  const std::vector<Frame> none;
  CHECK_THROWS_AS(export_motion({body.exported(), none}, scratch / "none"), InputError);
}

TEST_CASE("The same motion gives the same bytes") {
  const TemporaryFolder scratch;
  const Body body;
  const std::vector<Frame> frames = bending(body.model(), 4);
  const ExportedMotion motion{body.exported(), frames};
  for (const char* name : {"one.glb", "two.glb"}) export_motion(motion, scratch / name);
  // The name of a body is that of the file only where a script leaves it out.
  CHECK(read_file(scratch / "one.glb") == read_file(scratch / "two.glb"));
}
