#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "elastic/elastic_body.hpp"
#include "model/mass_spring.hpp"

// Static loads and how a body answers to them: the face of loads/.
namespace springlod::elastic {

// Loads on the whole body, and solving (static_loads.cpp).

/// Forces on the nodes of a model. For a body that nothing holds they need not balance: what would
/// only push or turn a part, or move a mechanism, is taken out when the load is solved for.
struct StaticLoad {
  std::string name;
  std::vector<Vec3> force;  ///< N [N]
};

/// How a body gives way to a load.
struct StaticSolution {
  /// N [m]; without rigid motion: sum m u = 0 and sum m r x u = 0 over each part that nothing
  /// holds. 0 for anchored nodes.
  std::vector<Vec3> displacement;
  /// Work of the balanced (anchored: of the given) forces along the displacement, f.u [J]: twice
  /// the elastic energy.
  double compliance = 0;
  /// Size of the iteration's last step over that of the displacement, both weighted by mass: what
  /// iterating on would change.
  double residual = 0;
};

struct StaticOptions {
  /// What may be left of the forces, over them (both over the root of the masses), for a load to
  /// count as solved; 0: iterate until nothing changes but by rounding. Above 0 one solution with
  /// the factors is mostly enough, and `residual` tells nothing.
  double balance = 0;
};

/// Nine smooth loads: "stretch x", "stretch y", "stretch z", "shear yz", "shear xz", "shear xy",
/// two bends of the longest axis of the bounding box ("bend z to x") and a twist about it
/// ("twist z"); nodes without volume count for nothing. Forces per volume are linear in the place
/// (bends and twist: of second order) about the centre of volume; of each load their amounts add up
/// to 1 N. A load that finds nothing to pull at (the width of a flat model) is all zeros.
std::vector<StaticLoad> smooth_loads(const MassSpringModel& model);

/// K u = f for each load, with the rigid motions projected out: of the forces as the inertia of the
/// accelerated body would balance them (f - M Z Z^T f), of the displacements by mass. Conjugate
/// gradients, preconditioned by the factors of the body.
/// Throws InputError for a load of another size than N or with forces that are not finite; for a
/// body with anchored nodes, also where a load pushes at a motion that the anchors leave free.
std::vector<StaticSolution> solve_static(const ElasticBody& body,
                                         const std::vector<StaticLoad>& loads,
                                         const StaticOptions& options = {});

// Loads on patches of the surface (local_loads.cpp).

/// Loads on patches of the surface: the border nodes around one of them, which share 1 N evenly.
/// Where they pull is drawn at random, the same for the same seed. All throw InputError if there is
/// no border node to pull at.
struct LocalLoadOptions {
  std::uint32_t count = 24;
  std::uint64_t seed = 1;
  /// Radius of a patch over the mean spring length: some thirty nodes, of which a level of a fifth
  /// of them keeps half a dozen. How a level answers to smaller ones depends on which groups they
  /// happen to cover.
  double radius = 3;
  /// Nodes that patches lie within, of which those on the border count; empty: all of the model.
  std::vector<std::uint32_t> within = {};
};

/// Two patches, pulled apart: every other pair near each other (at most two radii), the others
/// anywhere; about half of them along the line through their middles, half in any direction.
/// "patches 1", ... Fewer than asked for, or none, where there is no room for two.
std::vector<StaticLoad> patch_pairs(const MassSpringModel& model, const LocalLoadOptions& options);

/// A patch and the one that lies opposite as seen along the surface's normal, squeezed together:
/// "pinch 1", ... The one opposite may lie outside the nodes chosen.
std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options);

/// One patch pushed in any direction: "push 1", ... What balances it is the inertia of the body, or
/// whatever holds it; see solve_static.
std::vector<StaticLoad> pushes(const MassSpringModel& model, const LocalLoadOptions& options);

// Loads on each material region alone (piece_loads.cpp).

struct PieceOptions {
  std::size_t most_pieces = 6;   ///< the largest ones
  std::size_t least_nodes = 20;  ///< of a piece: fewer have no stiffness of their own
};

/// The nine smooth loads on each piece of one material alone (nodes joined by springs within the
/// material) that reaches the surface, for how stiff it is by itself: loads on the whole body tell
/// little of stiff pieces that soft ones join. "stretch x of rod at node 0", ... None if the body
/// is one piece.
std::vector<StaticLoad> piece_loads(const MassSpringModel& model, const PieceOptions& options = {});

}  // namespace springlod::elastic
