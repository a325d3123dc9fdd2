#include "voxelize/cells/resolution.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "base/units.hpp"
#include "voxelize/mesh/thickness.hpp"

namespace springlod::voxelize {
namespace {

// Relative error of a solid's volume in cells above which it is a fault.
constexpr double kVolumeTolerance = 0.1;
// Ratio of the volumes of cells and mesh above which an error in percent is hard to read [1].
constexpr double kFarOff = 10;
// Fraction of the cells' volume below which that of the mesh is rounding: the surface lacks
// triangles, or is folded onto itself.
constexpr double kNoVolume = 1e-6;
// Cells across a part of which it consists well enough.
constexpr double kThin = 3;
// Fraction of a solid's cells in slivers below which they are tips and burrs of its surface.
constexpr double kFewSlivers = 0.01;

/// "21.5 cm3"
std::string volume_text(double cubic_metres) {
  struct Unit {
    double size;  // [m3]
    const char* name;
  };
  // 0.05 m3 and 5000 cm3, in place of 50000 cm3 and 5e+06 mm3
  constexpr double kLeast = 0.01;  // [1]
  constexpr Unit kUnits[] = {{1, "m3"}, {1e-6, "cm3"}, {1e-9, "mm3"}};
  const Unit* unit = kUnits;
  while (unit != std::end(kUnits) - 1 && cubic_metres < kLeast * unit->size) ++unit;
  return fmt::format("{:.4g} {}", cubic_metres / unit->size, unit->name);
}

std::string cell_for(double thickness) {
  return fmt::format("about {} thick: use a cell of {}",
                     format_quantity(thickness, Dimension::length),
                     format_quantity(thickness / kThin, Dimension::length));
}

std::string advice_for(double thick, double cell) {
  if (!(thick > 0)) return "it is a sheet and encloses nothing";
  if (thick > kThin * cell)
    return fmt::format("use a smaller cell, such as {}, or check for crossing surfaces",
                       format_quantity(cell / 2, Dimension::length));
  return "it is " + cell_for(thick);
}

}  // namespace

std::optional<std::string> volume_fault(const TriangleMesh& mesh, const SolidReport& solid,
                                        double volume, double cells, double cell) {
  const double filled = cells * std::pow(cell, 3);
  if (cells > 0 && std::abs(filled - volume) <= kVolumeTolerance * volume) return std::nullopt;
  const std::string advice = advice_for(thickness(mesh, solid, volume), cell);
  if (cells == 0)
    return fmt::format("part \"{}\" is lost: no cell of {} has its centre inside; {}", solid.part,
                       format_quantity(cell, Dimension::length), advice);
  if (!(volume > kNoVolume * filled))
    return fmt::format(
        "part \"{}\": its surface encloses no volume, and yet {} of cells lie inside; check the "
        "mesh for missing or folded triangles",
        solid.part, volume_text(filled));
  const double ratio = filled / volume;
  const std::string error = ratio < kFarOff
                                ? fmt::format("has an error of {:+.0f} %", 100 * (ratio - 1))
                                : fmt::format("is {:.3g} times as large as it should be", ratio);
  return fmt::format("part \"{}\": the volume of its cells {} ({} against {} in the mesh); {}",
                     solid.part, error, volume_text(filled), volume_text(volume), advice);
}

std::optional<std::string> sliver_fault(const SolidReport& solid, const Sliver& sliver,
                                        std::size_t cells) {
  if (static_cast<double>(sliver.cells) < kFewSlivers * static_cast<double>(cells))
    return std::nullopt;
  return fmt::format(
      "part \"{}\": {} of its {} cells form plates or rods one cell thick, which bend far too "
      "easily; they are {}",
      solid.part, sliver.cells, cells, cell_for(sliver.thickness));
}

}  // namespace springlod::voxelize
