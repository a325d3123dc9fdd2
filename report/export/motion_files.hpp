#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "report/export/motion.hpp"

namespace springlod::report {

/// The files of one motion, written as they are made: a sequence may be larger than the memory.
class MotionFiles {
 public:
  explicit MotionFiles(std::filesystem::path stem) : stem_(std::move(stem)) {}

  /// Writes the file `stem + ending`.
  void write(std::string_view ending, std::string_view content);
  /// The name of that file without its folder.
  std::string name(std::string_view ending) const;

  ExportReport report;

 private:
  std::filesystem::path path(std::string_view ending) const;

  std::filesystem::path stem_;
};

/// "_0007": the number of a frame in the names of a sequence.
std::string frame_suffix(std::size_t frame);

/// Positions of the surface's vertices [m] when the nodes are at `x`.
std::vector<Vec3> surface_at(const ExportedModel& body, const std::vector<Vec3>& x);
/// Throws InputError for a body without a surface.
void require_surface(const ExportedModel& body, std::string_view format);

// One function for each format.
void write_skinned_glb(const ExportedMotion& motion, const MotionOptions& options,
                       MotionFiles& files);
void write_morphed_glb(const ExportedMotion& motion, const MotionOptions& options,
                       MotionFiles& files);
void write_pc2(const ExportedMotion& motion, const MotionOptions& options, MotionFiles& files);
void write_mdd(const ExportedMotion& motion, const MotionOptions& options, MotionFiles& files);
void write_vtu(const ExportedMotion& motion, const MotionOptions& options, MotionFiles& files);
void write_motion_npz(const ExportedMotion& motion, const MotionOptions& options,
                      MotionFiles& files);
void write_obj_sequence(const ExportedMotion& motion, const MotionOptions& options,
                        MotionFiles& files);

}  // namespace springlod::report
