#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "elastic/elastic_body.hpp"
#include "model/mass_spring.hpp"

// Static loads and the response of a body to them: the public header of loads/.
namespace springlod::elastic {

// Loads on the whole body, and their solution (static_loads.cpp).

/// Forces on the nodes of a model. On a free body they need not be in equilibrium: the component of
/// a load along rigid motions and mechanisms is projected out when it is solved (docs/method.md,
/// eq. 17).
struct StaticLoad {
  std::string name;
  std::vector<Vec3> force;  ///< N [N]
};

/// Static response of a body to a load.
struct StaticSolution {
  /// N [m]. In each connected component of a free body without rigid motion: sum m u = 0 and sum m
  /// r x u = 0. Anchored nodes: 0.
  std::vector<Vec3> displacement;
  /// Work of the projected forces (anchored body: of the given ones) along the displacement, f.u
  /// [J]: twice the elastic energy.
  double compliance = 0;
  /// Norm of the last iteration step / norm of the displacement, both weighted by mass. 0 if the
  /// solve ended without iterating.
  double residual = 0;
};

struct StaticOptions {
  /// Relative residual at which a load counts as solved: norm of the residual force / norm of the
  /// force, both divided by the root of the masses. 0: iterate until rounding errors prevent
  /// further improvement. Above 0, one solution with the factors usually suffices, and `residual`
  /// is then 0.
  double relative_tolerance = 0;
  /// Balance motions that the anchors leave free by inertia, as for a free body, instead of
  /// throwing InputError.
  bool balance_free_motions = false;
};

/// Nine smooth loads: "stretch x", "stretch y", "stretch z", "shear yz", "shear xz", "shear xy",
/// two bends of the longest axis of the bounding box ("bend z to x") and a twist about it ("twist
/// z"). Forces per volume are linear (bends and twist: quadratic) in the position relative to the
/// centre of volume. The magnitudes of the nodal forces of a load add up to 1 N. A load without a
/// lever arm (along the thickness of a flat model) is zero.
std::vector<StaticLoad> smooth_loads(const MassSpringModel& model);

/// Solves K u = f for each load (docs/method.md, eq. 17). The rigid motions are projected out of
/// the forces, f - M Z Z^T f (the inertia of the accelerated body), and out of the displacements,
/// weighted by mass. Conjugate gradients, preconditioned by the factors of the body.
///
/// Throws InputError for a load with a size other than N or with forces that are not finite. With
/// anchored nodes it also throws for a load on a motion that the anchors leave free.
std::vector<StaticSolution> solve_static(const ElasticBody& body,
                                         const std::vector<StaticLoad>& loads,
                                         const StaticOptions& options = {});

// Loads on patches of the surface (local_loads.cpp).

/// Loads on surface patches: the border nodes around a random one share 1 N evenly, or by their
/// contact areas if the body has a contact surface. The same seed gives the same patches. All
/// functions throw InputError if no border node can be loaded.
struct LocalLoadOptions {
  std::uint32_t count = 24;
  std::uint64_t seed = 1;
  /// Radius of a patch / mean spring length. With 3, a patch has some thirty nodes, and a level of
  /// a fifth of the nodes has half a dozen of them. The response of a level to smaller patches
  /// depends on which groups they happen to cover.
  double radius = 3;
  /// Nodes that patches are restricted to; those on the border count. Empty: the whole model.
  std::vector<std::uint32_t> within = {};
};

/// Two patches, pulled apart: "patches 1", ... Every other pair is close together (at most two
/// radii), the others are anywhere. About half of the pairs are pulled along the line between their
/// centres, the others in a random direction. Returns fewer loads, or none, if the surface has no
/// room for two patches, and fewer on surfaces of more than about 25,000 border nodes, where random
/// draws seldom find two that are close together.
std::vector<StaticLoad> patch_pairs(const MassSpringModel& model, const LocalLoadOptions& options);

/// A patch and the one opposite along the surface normal, pressed together: "pinch 1", ... The
/// opposite patch may lie outside the chosen nodes.
std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options);

/// One patch pushed in a random direction: "push 1", ... The inertia of the body or its anchors
/// balance it; see solve_static.
std::vector<StaticLoad> pushes(const MassSpringModel& model, const LocalLoadOptions& options);

// Loads on each material region alone (piece_loads.cpp).

struct PieceLoadOptions {
  std::size_t most_regions = 6;  ///< the largest are taken
  std::size_t least_nodes = 20;  ///< in a region; smaller ones have hardly any stiffness alone
};

/// The nine smooth loads on each material region (connected nodes of one material), at the surface
/// or inside: "stretch x of rod at node 0", ... They measure the stiffness of the region by itself;
/// loads on the whole body hardly depend on stiff regions that soft ones connect. Returns none if
/// the body is one region.
std::vector<StaticLoad> piece_loads(const MassSpringModel& model,
                                    const PieceLoadOptions& options = {});

}  // namespace springlod::elastic
