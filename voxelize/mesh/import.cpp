#include "voxelize/mesh/import.hpp"

#include <array>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "base/child_work.hpp"
#include "base/error.hpp"
#include "voxelize/mesh/mesh_bytes.hpp"
#include "voxelize/mesh/read_mesh.hpp"

namespace springlod::voxelize {
namespace {

namespace fs = std::filesystem;

// Several times what assimp needs: 10 MB of the slowest format take about a second and 300 MB.
constexpr double kSecondsPerByte = 1e-6;
constexpr std::uint64_t kMemoryPerByte = 100;

ChildLimits limits_for(const fs::path& path) {
  ChildLimits limits;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return limits;
  limits.seconds += kSecondsPerByte * static_cast<double>(size);
  limits.memory += kMemoryPerByte * size;
  return limits;
}

void require_unit(const std::optional<double>& unit) {
  if (unit && !(std::isfinite(*unit) && *unit > 0))
    throw InputError(fmt::format("unit = {} m must be a finite length above 0", *unit));
}

}  // namespace

ImportedMesh import_mesh(const fs::path& path, const ImportOptions& options) {
  require_unit(options.unit);
  const ChildLimits limits = limits_for(path);
  try {
    return mesh_from_bytes(
        run_in_child([&] { return to_bytes(read_mesh(path, options)); }, limits, options.progress));
  } catch (const ChildFailure& failure) {
    throw InputError(fmt::format(
        "cannot read {}: the reader of this format {}; the file is probably damaged: export it "
        "again, or to another format",
        path.string(), failure.what()));
  }
}

std::string describe(const ImportReport& report) {
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  const char* up = kAxes[static_cast<std::size_t>(report.up)];
  std::string text;
  if (report.unit_assumed)
    text +=
        fmt::format("assumed 1 unit = {:g} m ({} does not state it; the option unit changes it)\n",
                    report.unit, report.format);
  else
    text += fmt::format("1 unit = {:g} m\n", report.unit);
  if (report.up_assumed)
    text += fmt::format("assumed {} is up ({} does not state it; the option up changes it)\n", up,
                        report.format);
  else
    text += fmt::format("{} is up\n", up);
  if (report.stray_vertices > 0)
    text +=
        fmt::format("{} without triangles left out\n",
                    report.stray_vertices == 1 ? "1 vertex"
                                               : fmt::format("{} vertices", report.stray_vertices));
  return text;
}

}  // namespace springlod::voxelize
