#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Where the nodes of the cubic lattice sit (Ladd & Kinney 1997; 6 + 12 neighbours, k = E a / 2.5).
enum class LatticeStyle {
  /// At the corners of the cells: every filled cell gives rho a^3/8 to each corner, k/4 to each of
  /// its 12 edges, k/2 to each of its 12 face diagonals. No border error.
  corners,
  /// At the centres (the paper's): one k a spring, across materials that of two half springs in
  /// series, 2 k1 k2 / (k1 + k2), with the damping of their two half dampers in slow motion,
  /// c = k (beta1 k2 + beta2 k1) / (k1 + k2). Has no hinges as `corners` has them: diagonal springs
  /// join cells that touch along an edge, cells that touch at a corner are not joined.
  centers,
};

inline constexpr Choice<LatticeStyle> kLatticeStyles[] = {
    {LatticeStyle::corners, "corners", "nodes at the corners of the cells: no border error"},
    {LatticeStyle::centers, "centers", "nodes at the centers of the cells, as in the paper"}};
constexpr ChoiceTable<Choice<LatticeStyle>> choices(LatticeStyle) {
  return {"lattice", kLatticeStyles};
}

/// What to do where cells touch only along an edge or at a corner (a hinge).
enum class HingePolicy {
  report,    ///< leave it and say so
  fill,      ///< fill a neighbouring cell until the contact has a face
  separate,  ///< double the shared nodes, so that the cells come apart
};

inline constexpr Choice<HingePolicy> kHingePolicies[] = {
    {HingePolicy::report, "report", "leave them and report them"},
    {HingePolicy::fill, "fill", "fill a neighbouring cell"},
    {HingePolicy::separate, "separate", "double the shared nodes, so that the cells come apart"}};
constexpr ChoiceTable<Choice<HingePolicy>> choices(HingePolicy) {
  return {"hinges", kHingePolicies};
}

struct Hinge {
  Vec3 position = Vec3::Zero();  ///< of the shared corner, or the middle of the shared edge [m]
  bool along_edge = false;       ///< false: at a corner only
};

struct LatticeOptions {
  LatticeStyle style = LatticeStyle::corners;
  HingePolicy hinges = HingePolicy::report;
};
constexpr auto option_rows(const LatticeOptions*) {
  return std::tuple(option("style", &LatticeOptions::style, "where the nodes sit"),
                    option("hinges", &LatticeOptions::hinges,
                           "what to do where cells touch only along an edge or at a corner"));
}

struct LatticeModel {
  MassSpringModel model;
  std::vector<Hinge> hinges;       ///< found (and for fill/separate: mended)
  std::uint32_t filled_cells = 0;  ///< added by HingePolicy::fill
  std::uint32_t parts = 0;         ///< connected parts of the model
};

/// Nodes in the order (z, y, x). Contact areas are the areas of the exposed cell faces (a quarter
/// to each corner under `corners`). Border: a node that lacks one of its 18 lattice neighbours
/// (`centers`: 6 axis neighbours or 12 diagonal ones; `corners`: one of its 8 cells is not filled).
/// Throws InputError for an empty grid.
LatticeModel build_lattice(const MaterialGrid& grid, const LatticeOptions& options = {});

}  // namespace springlod::voxelize
