#include "voxelize/lattice/cell_dilatation.hpp"

#include <algorithm>
#include <array>

namespace springlod::voxelize {
namespace {

constexpr unsigned kCorners = 8;

/// b of a corner of a cell.
Vec3 corner_gradient(unsigned corner, double cell) {
  const auto side = [&](unsigned axis) { return (corner >> axis & 1U) != 0 ? 1.0 : -1.0; };
  return Vec3(side(0), side(1), side(2)) / (4 * cell);
}

}  // namespace

DilatationTerms cell_terms(const MaterialGrid& grid, const CornerNodes& nodes) {
  DilatationTerms terms;
  const auto has_term = [&](std::uint16_t material) {
    return dilatation_modulus(grid.materials[material]) != 0;
  };
  const auto count =
      static_cast<std::size_t>(std::count_if(grid.material.begin(), grid.material.end(), has_term));
  if (count == 0) return terms;
  terms.reserve(count, kCorners * count);
  const double volume = grid.cell * grid.cell * grid.cell;
  for (std::size_t cell = 0; cell < grid.cells.size(); ++cell) {
    if (!has_term(grid.material[cell])) continue;
    const Material& material = grid.materials[grid.material[cell]];
    // Separated hinges may leave the corners of a cell in any order.
    std::array<unsigned, kCorners> corner{0, 1, 2, 3, 4, 5, 6, 7};
    const auto& of_cell = nodes.of_cell[cell];
    std::sort(corner.begin(), corner.end(),
              [&](unsigned l, unsigned r) { return of_cell[l] < of_cell[r]; });
    std::array<std::uint32_t, kCorners> node{};
    std::array<Vec3, kCorners> gradient;
    for (unsigned i = 0; i < kCorners; ++i) {
      node[i] = of_cell[corner[i]];
      gradient[i] = corner_gradient(corner[i], grid.cell);
    }
    terms.add(grid.fraction_of(cell) * dilatation_modulus(material) * volume, material.damping,
              node, gradient);
  }
  return terms;
}

}  // namespace springlod::voxelize
