#include "report/export/motion.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "report/export/motion_files.hpp"
#include "report/playback.hpp"

namespace springlod::report {

namespace {

constexpr MotionFormatChoice kFormats[] = {
    {{MotionFormat::glb, "glb", "glTF, the surface skinned on the nodes"},
     ".glb",
     write_skinned_glb},
    {{MotionFormat::glb_morph, "glb_morph", "glTF, a morph target of the surface for each frame"},
     ".glb",
     write_morphed_glb},
    {{MotionFormat::pc2, "pc2", "point cache of the surface, with the mesh as OBJ"},
     ".pc2",
     write_pc2},
    {{MotionFormat::mdd, "mdd", "point cache of the surface, with the mesh as OBJ"},
     ".mdd",
     write_mdd},
    {{MotionFormat::vtu, "vtu", "a VTK file of nodes and springs for each frame, and a .pvd"},
     ".pvd",
     write_vtu},
    {{MotionFormat::npz, "npz", "NumPy: times, and positions of nodes and surface, frame by frame"},
     ".npz",
     write_motion_npz},
    {{MotionFormat::obj, "obj", "an OBJ file of the surface for each frame"},
     ".obj",
     write_obj_sequence},
};

// At multiples of 1 / rate from the first frame to the last.
std::vector<sim::Frame> resampled(const std::vector<sim::Frame>& frames, double rate) {
  const double start = frames.front().time;
  // A duration of a whole number of frames keeps its last one in spite of rounding.
  constexpr double kRounding = 1e-9;
  const double count = std::floor((frames.back().time - start) * rate + kRounding);
  std::vector<sim::Frame> result;
  for (double n = 0; n <= count; ++n) {
    const double time = std::min(start + n / rate, frames.back().time);
    result.push_back({time, positions_at(frames, time)});
  }
  return result;
}

}  // namespace

ChoiceTable<MotionFormatChoice> choices(MotionFormat) {
  return {"motion_format", kFormats};
}

ExportReport export_motion(const ExportedMotion& motion, const std::filesystem::path& path,
                           const MotionOptions& options) {
  if (motion.frames.empty()) throw InputError("export_motion: the run has no frames");
  const MotionFormatChoice& row = choice_of(options.format);
  std::filesystem::path stem = path;
  if (stem.extension() == row.ending) stem.replace_extension();
  MotionFiles files(stem);
  if (options.frame_rate) {
    const std::vector<sim::Frame> frames = resampled(motion.frames, *options.frame_rate);
    row.write({motion.body, frames}, options, files);
  } else {
    row.write(motion, options, files);
  }
  return files.report;
}

void MotionFiles::write(std::string_view ending, std::string_view content) {
  report.files.push_back(path(ending));
  const auto save = [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) throw IoError(fmt::format("cannot write {}", report.files.back().string()));
  };
  // Frames are quickly made again; waiting for the disk would take longer than making them.
  write_aside(report.files.back(), save, Durability::unsynced);
}

std::string MotionFiles::name(std::string_view ending) const {
  return path(ending).filename().string();
}

std::filesystem::path MotionFiles::path(std::string_view ending) const {
  std::filesystem::path whole = stem_;
  whole += ending;
  return whole;
}

std::string frame_suffix(std::size_t frame) {
  return fmt::format("_{:04}", frame);
}

std::vector<Vec3> surface_at(const ExportedModel& body, const std::vector<Vec3>& x) {
  return interpolate(body.surface_of_nodes, x);
}

void require_surface(const ExportedModel& body, std::string_view format) {
  if (!body.surface)
    throw InputError(fmt::format(
        "export_motion: the body has no surface, which {} needs; vtu holds nodes and springs",
        format));
}

}  // namespace springlod::report
