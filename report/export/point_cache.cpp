// PC2 and MDD: the positions of the vertices of a mesh, frame by frame.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "report/export/draft.hpp"
#include "report/export/motion_files.hpp"
#include "report/export/obj_text.hpp"

namespace springlod::report {

namespace {

template <class T>
void append(std::string& bytes, T value, std::endian order) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (order != std::endian::native) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

void append_points(std::string& bytes, const std::vector<Vec3>& points, std::endian order) {
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(p[axis]), order);
}

double rate_of(const std::vector<sim::Frame>& frames) {
  const double span = frames.back().time - frames.front().time;
  return span > 0 ? static_cast<double>(frames.size() - 1) / span : 1;
}

// The mesh that a cache moves: the same vertices in the same order.
void write_mesh(const ExportedMotion& motion, MotionFiles& files) {
  files.write(".obj", obj_text(motion.body, surface_points(motion.body)));
  files.report.settings.push_back(
      fmt::format("Blender: import {} with forward Y and up Z, then add the modifier Mesh Cache",
                  files.name(".obj")));
  files.report.losses.push_back("everything but the positions of the surface's vertices");
}

}  // namespace

void write_pc2(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  require_surface(motion.body, "pc2");
  constexpr std::endian kOrder = std::endian::little;
  std::string bytes("POINTCACHE2\0", 12);
  append(bytes, std::int32_t{1}, kOrder);  // version
  append(bytes, static_cast<std::int32_t>(motion.body.surface->positions.size()), kOrder);
  append(bytes, 0.0F, kOrder);  // first frame
  append(bytes, 1.0F, kOrder);  // frames between samples
  append(bytes, static_cast<std::int32_t>(motion.frames.size()), kOrder);
  for (const sim::Frame& frame : motion.frames)
    append_points(bytes, surface_at(motion.body, frame.x), kOrder);
  files.write(".pc2", bytes);
  files.report.settings.push_back(fmt::format("{} frames; play them at {:.4g} frames per second",
                                              motion.frames.size(), rate_of(motion.frames)));
  write_mesh(motion, files);
}

void write_mdd(const ExportedMotion& motion, const MotionOptions&, MotionFiles& files) {
  require_surface(motion.body, "mdd");
  constexpr std::endian kOrder = std::endian::big;
  std::string bytes;
  append(bytes, static_cast<std::int32_t>(motion.frames.size()), kOrder);
  append(bytes, static_cast<std::int32_t>(motion.body.surface->positions.size()), kOrder);
  for (const sim::Frame& frame : motion.frames)
    append(bytes, static_cast<float>(frame.time), kOrder);
  for (const sim::Frame& frame : motion.frames)
    append_points(bytes, surface_at(motion.body, frame.x), kOrder);
  files.write(".mdd", bytes);
  write_mesh(motion, files);
}

}  // namespace springlod::report
