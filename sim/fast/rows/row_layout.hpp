#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/place.hpp"

namespace springlod::sim {

/// Springs or nodes in one vector operation [lanes].
inline constexpr std::uint32_t kRowLanes = 8;

/// Springs from eight consecutive places to the eight that lie `ahead` places further on.
struct SpringRow {
  std::uint32_t ahead = 0;
  std::uint32_t properties = 0;  ///< index into RowLayout::properties
};

/// Properties of the eight springs of a row; all 0 for a missing spring.
template <class Real>
struct RowProperties {
  Real stiffness[kRowLanes] = {};   ///< k [N/m]
  Real rest_force[kRowLanes] = {};  ///< k L [N]
  Real damping[kRowLanes] = {};     ///< c [N s/m]
  bool operator==(const RowProperties&) const = default;
};

/// Nodes of the dilatation term of a cell.
inline constexpr std::uint32_t kCellNodes = 8;

/// The dilatation terms of eight cells, whose first nodes are at consecutive places.
struct TermRow {
  std::array<std::uint32_t, kCellNodes> ahead = {};  ///< places of the nodes after the first
  std::uint32_t properties = 0;                      ///< index into RowTerms::properties
  std::uint32_t shape = 0;                           ///< index into RowTerms::shapes
};

/// Moduli of the eight terms of a row; all 0 for a missing term.
template <class Real>
struct TermProperties {
  Real modulus[kRowLanes] = {};  ///< T [J]
  Real damping[kRowLanes] = {};  ///< beta T [J s]
  bool operator==(const TermProperties&) const = default;
};

/// b [1/m] of the nodes of the cells of a row, which they share, in the order of the places.
template <class Real>
struct TermShape {
  Real gradient[kCellNodes][3] = {};
  bool operator==(const TermShape&) const = default;
};

/// Dilatation terms in rows.
template <class Real>
struct RowTerms {
  std::vector<TermRow> rows;             ///< in the order of the places of their first nodes
  std::vector<std::uint32_t> first_row;  ///< of each eight places, and the end; empty without terms
  std::vector<TermProperties<Real>> properties;
  std::vector<TermShape<Real>> shapes;
};

/// Lengths of the eight springs of a row.
template <class Real>
struct RowLengths {
  Real inverse_square[kRowLanes] = {};  ///< 1 / L^2 [1/m2]; 0 for a missing spring
  Real missing[kRowLanes] = {};         ///< 1 for a missing spring, else 0
};

/// Combinations of one side along each axis [1]. Bits 2, 1 and 0 of the number of an octant:
/// whether it is on the upper side along x, y and z.
inline constexpr std::uint32_t kOctants = 8;

/// The corners of eight consecutive places. They end at the same neighbours, counted from each
/// place: one on each side along each axis. Each octant may have a corner.
struct CornerStar {
  std::uint32_t base = 0;               ///< first of the eight places
  std::uint32_t properties = 0;         ///< index into RowCorners::properties
  std::array<std::int32_t, 6> to = {};  ///< places to the lower and upper x, y and z; 0 if unused
};

/// MarginTerms of the corners of a star, by octant and lane. The sign of `scale` is that of the
/// determinant of the edges along x, y and z at rest.
template <class Real>
struct StarProperties {
  Real scale[kOctants][kRowLanes];   ///< [1/m2]
  Real offset[kOctants][kRowLanes];  ///< [m]
  bool operator==(const StarProperties&) const = default;
};

/// The corners of a lattice, at their own nodes. Stars with equal properties share them.
template <class Real>
struct RowCorners {
  std::vector<CornerStar> stars;          ///< in the order of the blocks
  std::vector<std::uint32_t> first_star;  ///< of each block, and the end; empty without corners
  std::vector<StarProperties<Real>> properties;
  /// Number of each corner in the model, by star, octant and lane; or kNoCorner.
  std::vector<std::array<std::array<std::uint32_t, kRowLanes>, kOctants>> numbers;
  std::uint32_t end = 0;  ///< after the last place that a star reads

  std::uint32_t star_count(std::size_t block) const {
    return first_star.empty() ? 0 : first_star[block + 1] - first_star[block];
  }
};

/// Consecutive places whose rows one thread computes.
struct RowBlock {
  std::uint32_t first = 0;  ///< place, a multiple of kRowLanes
  std::uint32_t own = 0;    ///< places
  std::uint32_t reach = 0;  ///< places after its own at which its springs end, in whole rows
  /// Own places, padded to whole rows.
  std::uint32_t places() const { return (own + kRowLanes - 1) / kRowLanes * kRowLanes; }
};

/// A lattice laid out for fast steps. Nodes are sorted by layer, line and column, so that the
/// neighbours of adjacent nodes are adjacent too. Eight springs of one direction form a *row*,
/// whose ends are contiguous in memory and need no gather. Each spring is computed once, from its
/// first node. Rows with equal properties share them: 1 to 2 bytes per spring.
template <class Real>
struct RowLayout {
  std::vector<std::uint32_t> node;       ///< node at each place; N
  std::vector<std::uint32_t> first_row;  ///< first row of each eight places, and the end
  std::vector<SpringRow> rows;           ///< in the order of the places
  std::vector<RowProperties<Real>> properties;
  std::vector<RowLengths<Real>> lengths;  ///< by the index of the properties
  RowTerms<Real> dilatation;
  RowCorners<Real> corners;  ///< see make_row_layout()
  std::vector<RowBlock> blocks;
  std::vector<Place> place;        ///< place of each node; N
  std::vector<Real> inverse_mass;  ///< by place, padded with 0 to a multiple of kRowLanes [1/kg]
  std::uint32_t reach = 0;         ///< largest reach of a block

  std::uint32_t block_places = 0;  ///< places of every block but the last

  /// The first block whose springs may end at places of this block.
  std::uint32_t first_contributor(std::uint32_t block) const {
    const std::uint32_t back = (reach + block_places - 1) / block_places;
    return block > back ? block - back : 0;
  }
};

/// Whether all dilatation terms of the model are those of cells: each over eight nodes. Rows take
/// no others.
bool has_terms_of_cells(const MassSpringModel& model);

/// Without corners, which place_corners() makes: few models that are laid out to count their rows
/// run in them. The model must have no dilatation terms but those of cells.
template <class Real>
RowLayout<Real> make_row_layout(const MassSpringModel& model);

}  // namespace springlod::sim
