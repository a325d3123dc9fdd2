#pragma once

#include <cstdint>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Positions of the nodes of the cubic lattice (6 + 12 neighbours, k = E a / 2.5; Ladd & Kinney
/// 1997; docs/method.md, eq. 1).
enum class LatticeStyle {
  /// Nodes at the corners of the cells: every filled cell contributes rho a^3/8 to each corner, k/4
  /// to each of its 12 edges and k/2 to each of its 12 face diagonals (docs/method.md, eq. 4). The
  /// surface is as stiff as the inside.
  corners,
  /// Nodes at the centres of the cells, as in the paper. A spring between two materials is two half
  /// springs in series, k = 2 k1 k2 / (k1 + k2), c = k (beta1 k2 + beta2 k1) / (k1 + k2)
  /// (docs/method.md, eq. 5). No hinges are reported: diagonal springs connect cells that touch
  /// along an edge, and no spring connects cells that touch at a corner.
  centers,
};

inline constexpr Choice<LatticeStyle> kLatticeStyles[] = {
    {LatticeStyle::corners, "corners", "nodes at the corners of the cells: no border error"},
    {LatticeStyle::centers, "centers", "nodes at the centers of the cells, as in the paper"}};
constexpr ChoiceTable<Choice<LatticeStyle>> choices(LatticeStyle) {
  return {"lattice", kLatticeStyles};
}

/// How a cell shares its springs and its mass between its two opposite faces along an axis, where
/// one of them is free and the other is not; only for `corners`.
enum class Bending {
  /// By halves. A stretched bar has the material's E and nu exactly; a bent one is too stiff, by
  /// an error of second order in the cell size, since the springs at its surface count too much.
  plain,
  /// The free face has 1/12 less than one half, the other one 1/12 more: the end correction of
  /// Euler and Maclaurin for the sum over the layers, which makes bending, twisting and moments of
  /// inertia accurate to a higher order (docs/method.md, eq. 4a).
  corrected,
};

inline constexpr Choice<Bending> kBendings[] = {
    {Bending::plain, "plain", "stretching is exact, bending of second order in the cell size"},
    {Bending::corrected, "corrected",
     "bending and twisting are as accurate as with half the cell size or less"}};
constexpr ChoiceTable<Choice<Bending>> choices(Bending) {
  return {"bending", kBendings};
}

/// What to do where cells touch only along an edge or at a corner (a hinge).
enum class HingePolicy {
  report,    ///< keep and report them
  fill,      ///< fill neighbouring cells until the cells share faces
  separate,  ///< duplicate the shared nodes, which disconnects the cells
};

inline constexpr Choice<HingePolicy> kHingePolicies[] = {
    {HingePolicy::report, "report", "keep and report them"},
    {HingePolicy::fill, "fill", "fill a neighbouring cell"},
    {HingePolicy::separate, "separate", "duplicate the shared nodes, which disconnects the cells"}};
constexpr ChoiceTable<Choice<HingePolicy>> choices(HingePolicy) {
  return {"hinges", kHingePolicies};
}

struct Hinge {
  Vec3 position = Vec3::Zero();  ///< of the shared corner, or the middle of the shared edge [m]
  bool along_edge = false;       ///< false: at a corner
};

struct LatticeOptions {
  LatticeStyle style = LatticeStyle::corners;
  HingePolicy hinges = HingePolicy::report;
  /// Whether the model gets corners (model/corners.hpp): `corners`: the eight corners of each cell,
  /// with its E; `centers`: each node with a neighbour along each axis, for each such choice of
  /// three neighbours, with the harmonic mean of E at the four nodes.
  bool volumes = true;
  Bending bending = Bending::plain;
};
inline constexpr const char* kVolumesHelp =
    "give the model the corners of its cells, whose volumes keep their signs, so that soft bodies "
    "do not turn inside out; false: springs only, as in the paper";
constexpr auto option_rows(const LatticeOptions*) {
  return std::tuple(
      option("style", &LatticeOptions::style, "position of the nodes"),
      option("hinges", &LatticeOptions::hinges,
             "treatment of places where cells touch only along an edge or at a corner"),
      option("volumes", &LatticeOptions::volumes, kVolumesHelp),
      option("bending", &LatticeOptions::bending,
             "share of springs and mass at free faces, of the style corners"));
}

struct LatticeModel {
  MassSpringModel model;
  std::vector<Hinge> hinges;       ///< those of the grid; fill and separate remove them
  std::uint32_t filled_cells = 0;  ///< added by HingePolicy::fill
  std::uint32_t components = 0;    ///< number of connected components
};

/// Builds a lattice. Nodes are in the order (z, y, x). Contact areas are the areas of the exposed
/// cell faces (`corners`: a quarter for each corner). A border node lacks one of its 18 lattice
/// neighbours (`centers`) or one of its 8 cells (`corners`).
///
/// A cut cell counts by its fraction: its springs, their dampers, its mass, its dilatation term and
/// its corners all do, so that no part of it vibrates faster than a whole cell (docs/method.md, eq.
/// 4b). A grid with points of its surface gives the model its contact surface; each node then has
/// the area that the weights of the points give it.
///
/// Throws InputError for an empty grid, and for corrected bending and cut cells of `centers`.
LatticeModel build_lattice(const MaterialGrid& grid, const LatticeOptions& options = {});

}  // namespace springlod::voxelize
