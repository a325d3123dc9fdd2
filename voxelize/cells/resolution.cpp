#include "voxelize/cells/resolution.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/units.hpp"

namespace springlod::voxelize {
namespace {

// Relative error of a solid's volume in cells above which it is a fault.
constexpr double kVolumeTolerance = 0.1;
// Cells across a part of which it consists well enough.
constexpr double kThin = 3;
// Fraction of a solid's cells in slivers below which they are tips and burrs of its surface.
constexpr double kFewSlivers = 0.01;

std::string cell_for(double thickness) {
  return fmt::format("about {} thick: use a cell of {}",
                     format_quantity(thickness, Dimension::length),
                     format_quantity(thickness / kThin, Dimension::length));
}

std::string advice_for(double thick, double cell) {
  if (!(thick > 0)) return "it is a sheet and encloses nothing";
  if (thick > kThin * cell) return "use a smaller cell or check for crossing surfaces";
  return "it is " + cell_for(thick);
}

}  // namespace

std::optional<std::string> volume_fault(const TriangleMesh& mesh, const SolidReport& solid,
                                        double volume, double cells, double cell) {
  const double filled = cells * std::pow(cell, 3);
  if (cells > 0 && std::abs(filled - volume) <= kVolumeTolerance * volume) return std::nullopt;
  const std::string advice = advice_for(thickness(mesh, solid, volume), cell);
  if (cells == 0)
    return fmt::format("part \"{}\" is lost: no cell of {:.4g} m has its centre inside; {}",
                       solid.part, cell, advice);
  return fmt::format(
      "part \"{}\": the volume of its cells has an error of {:+.0f} % ({:.4g} m3 against {:.4g} m3 "
      "in the mesh); {}",
      solid.part, 100 * (filled / volume - 1), filled, volume, advice);
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
