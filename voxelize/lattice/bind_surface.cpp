#include "voxelize/lattice/bind_surface.hpp"

#include <algorithm>
#include <array>

#include "voxelize/index_lookup.hpp"
#include "voxelize/lattice/cell_stiffness.hpp"

namespace springlod::voxelize {
namespace {

constexpr unsigned kCorners = 8;

std::array<double, kCorners> trilinear_weights(const std::array<float, 3>& place) {
  std::array<double, kCorners> weights{};
  for (unsigned corner = 0; corner < kCorners; ++corner) {
    double weight = 1;
    for (unsigned axis = 0; axis < 3; ++axis)
      weight *= 0.5 + ((corner >> axis & 1U) != 0 ? 1. : -1.) * place[axis];
    weights[corner] = weight;
  }
  return weights;
}

}  // namespace

void bind_surface(const MaterialGrid& grid, const CornerNodes& nodes, MassSpringModel& model) {
  if (grid.surface.empty()) return;
  const IndexLookup lookup(grid.cells);
  ContactSurface& surface = model.surface;
  Binding& binding = surface.of_nodes;
  binding.start.push_back(0);
  std::vector<double> area(model.node_count(), 0);
  for (const SurfacePoint& point : grid.surface) {
    const std::uint32_t cell = lookup.find(point.cell);
    const std::array<double, kCorners> weights = trilinear_weights(point.place);
    for (unsigned corner = 0; corner < kCorners; ++corner) {
      if (weights[corner] == 0) continue;
      const std::uint32_t node = nodes.of_cell[cell][corner];
      binding.node.push_back(node);
      binding.weight.push_back(weights[corner]);
      area[node] += weights[corner] * point.area;
    }
    binding.start.push_back(static_cast<std::uint32_t>(binding.node.size()));
    surface.normal.push_back(Vec3(point.normal[0], point.normal[1], point.normal[2]).normalized());
    surface.area.push_back(point.area);
    surface.stiffness.push_back(
        layer_stiffness(grid.materials[grid.material[cell]], point.area, grid.cell));
  }
  // Points outside their cell have weights below 0.
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    model.contact_area[i] = std::max(0.0, area[i]);
}

}  // namespace springlod::voxelize
