#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::report {

/// Tetrahedra over the nodes of a model, six a cell, in one order: all tetrahedra of a cell are
/// consecutive. They are conforming: an inner face belongs to exactly two.
///
/// A cell that the surface cuts is whole here, and as stiff and heavy as its filled fraction: its
/// Young's modulus and density are those of its material times `fraction`, as in the model.
struct Tetrahedra {
  std::vector<std::array<std::uint32_t, 4>> nodes;  ///< T; det(x1 - x0, x2 - x0, x3 - x0) > 0
  std::vector<std::uint32_t> material;              ///< T; index into the materials of the model
  std::vector<double> fraction;                     ///< T; filled fraction of the cell [1], 0 to 1
  double cell = 0;                                  ///< edge of a cell [m]

  bool empty() const { return nodes.empty(); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(nodes.size()); }
};

/// The cells of a `corners` lattice, each split into six tetrahedra along its diagonal (Kuhn 1960).
/// They are found by the corners of the model. Empty for a model whose corners are not those of
/// cubes along the axes that hold all its volume: merged levels, random bodies, `centers` lattices,
/// and lattices built without corners.
Tetrahedra tetrahedra_of_cells(const MassSpringModel& model);

/// Why a model has no tetrahedra, and what to do: a line for losses.
std::string no_tetrahedra(const MassSpringModel& model);

// Of the material of each tetrahedron.
std::vector<double> young_of(const MassSpringModel& model, const Tetrahedra& of);    ///< E [Pa], T
std::vector<double> poisson_of(const MassSpringModel& model, const Tetrahedra& of);  ///< nu [1], T
std::vector<double> density_of(const MassSpringModel& model, const Tetrahedra& of);  ///< [kg/m3], T

}  // namespace springlod::report
