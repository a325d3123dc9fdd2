#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "voxelize/bodies.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {
namespace {

/// Sums over the cells of a component.
struct Component {
  CellIndex low{};
  CellIndex high{};
  double cells = 0;
  double compliance = 0;  // sum of 1/E [1/Pa]
  double density = 0;     // sum [kg/m3]

  void add(const CellIndex& cell, const Material& material) {
    if (cells == 0) low = high = cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
    cells += 1;
    compliance += 1 / material.young;
    density += material.density;
  }
  double extent_in_cells() const {
    std::int32_t most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) most = std::max(most, high[axis] - low[axis]);
    return most + 1.0;
  }
  /// Of the materials in series [m/s].
  double wave_speed() const { return cells / std::sqrt(compliance * density); }
};

double lowest_frequency(const MaterialGrid& grid, const DisjointSets::Numbers& bodies) {
  if (grid.cells.empty()) return 0;
  std::vector<Component> components(bodies.count);
  for (std::size_t n = 0; n < grid.cells.size(); ++n)
    components[bodies.of[n]].add(grid.cells[n], grid.materials[grid.material[n]]);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Component& component : components)
    lowest = std::min(lowest, lowest_frequency_estimate(component.wave_speed(),
                                                        grid.cell * component.extent_in_cells()));
  return lowest;
}

}  // namespace

double lowest_frequency(const MaterialGrid& grid) {
  return lowest_frequency(grid, bodies_of(grid.cells));
}

void set_materials(MaterialGrid& grid, const std::vector<MaterialInput>& inputs) {
  set_materials(grid, inputs, bodies_of(grid.cells));
}

void set_materials(MaterialGrid& grid, const std::vector<MaterialInput>& inputs,
                   const DisjointSets::Numbers& bodies) {
  grid.inputs = inputs;
  grid.materials.clear();
  for (const MaterialInput& input : inputs) {
    validate(input);
    grid.materials.push_back(resolved(input, 0));
  }
  validate(grid);
  const double omega = lowest_frequency(grid, bodies);
  for (std::size_t n = 0; n < inputs.size(); ++n) grid.materials[n] = resolved(inputs[n], omega);
}

}  // namespace springlod::voxelize
