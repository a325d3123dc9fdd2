#pragma once

#include <cstdint>
#include <vector>

#include "elastic/loads.hpp"
#include "model/mass_spring.hpp"
#include "model/vec.hpp"

// Effective elastic moduli of a model, estimated or measured: the public header of moduli/.
namespace springlod::elastic {

// Estimated by eq. 2 (estimate.cpp).

/// Moduli of some nodes of a model by eq. 2 (docs/method.md). With W the sum of k L^2 over their
/// springs, half of a spring at either end, Lambda V their shares of the dilatation terms, and V
/// the volume: mu = W / (15 V), K = W / (9 V) + Lambda, and E from both; without terms W / (6 V).
struct Eq2Estimate {
  std::uint32_t nodes = 0;
  double mass = 0;        ///< [kg]
  double volume = 0;      ///< [m3]
  double work = 0;        ///< W [N m]
  double dilatation = 0;  ///< Lambda V [J]
  double density = 0;     ///< [kg/m3]
  double young = 0;       ///< E [Pa]
  double shear = 0;       ///< mu [Pa]; without terms also Lame's lambda
  double bulk = 0;        ///< K [Pa]
};

struct ModelEstimate {
  Eq2Estimate whole;
  /// For each of model.materials, over the nodes that have it; all 0 if none has.
  std::vector<Eq2Estimate> materials;
  std::vector<double> young;    ///< of each node [Pa] N
  std::vector<double> density;  ///< of each node [kg/m3] N
};

/// Moduli by eq. 2: upper bounds, as nodes need not move affinely (stretch_test measures). Springs
/// across an interface count half for the material of each end, which blurs the estimates of both.
ModelEstimate estimate(const MassSpringModel& model);

// Measured from solved loads, by material (measured_moduli.cpp).

/// Effective moduli of one material of a model.
struct MaterialModuli {
  std::uint32_t material = 0;  ///< number in the model's list
  double young = 0;            ///< E [Pa]
  double poisson = 0;          ///< nu
  double volume = 0;           ///< of its nodes [m3]
};

/// E and nu of each material, fitted to static solutions (docs/method.md, eqs. 9 and 10): the
/// isotropic law closest to the volume averages of stress (virial of the springs; one between two
/// materials counts half for each, and dilatation terms count in equal parts for their nodes) and
/// strain (of each node from its springs within the material). A solution counts by how little its
/// strains cancel; those whose averages are near zero (bends, twists) are left out. Soft and stiff
/// loads count alike.
///
/// The error is below 1 % for one material on a lattice, and some percent where much of a material
/// lies at an interface, whose nodes have springs of both materials.
///
/// A material is omitted if it has no nodes, if most of its volume is in nodes whose springs within
/// the material are coplanar, or if no solution strains it. Throws InputError for displacements of
/// a size other than N.
std::vector<MaterialModuli> measured_moduli(const MassSpringModel& model,
                                            const std::vector<StaticSolution>& solutions);

// Measured by pulling two ends (stretch.cpp).

/// Result of a stretch test along `axis` (0 x, 1 y, 2 z). The ends are displaced along the axis and
/// free to contract; Young's modulus follows from the reaction over the cross-section, Poisson's
/// ratio from the contraction of the middle half.
///
/// The ends are the nodes within half a mean spring length of the extreme nodes: one plane of nodes
/// in a lattice. A node of an end has the displacement of uniform strain along the axis. In merged
/// and random models, whose ends are not planar, this prescribes uniform strain in the layer at
/// either end (slightly too stiff); one common displacement would not strain the layer at all.
struct StretchResult {
  double young = 0;  ///< [Pa]
  /// Least squares over the middle half of the length, mean of both lateral directions; NaN if the
  /// nodes there have no width.
  double poisson = 0;
  double reaction = 0;       ///< [N] at strain 1 (linear theory)
  double strain_energy = 0;  ///< [J] at strain 1 (linear theory)
};
struct StretchOptions {
  int axis = 2;
  /// Cross-section [m2]; 0: volume of the model / distance between its extreme nodes. Needed for
  /// models whose nodes do not reach the ends of the body (`centers` lattices, merged models).
  double cross_section = 0;
};
/// Stretch test by conjugate gradients. Motions that no spring resists (lateral rigid motions,
/// mechanisms) do not enter the solution. Throws InputError for a model with fewer than two planes
/// of nodes along the axis, another axis than these, and if the iteration does not converge.
StretchResult stretch_test(const MassSpringModel& model, const StretchOptions& options = {});

// Measured by pulling the surface of a body of any shape (surface_stretch.cpp).

/// Effective moduli of a body of any shape.
struct SurfaceStretchResult {
  double young = 0;    ///< mean over x, y, z [Pa]
  double poisson = 0;  ///< mean over the six pairs of axes
};

/// A stretch test for any shape: under surface tractions sigma n, a body of one material is in
/// uniform stress sigma whatever its shape (Nemat-Nasser & Hori 1999, sect. 2), and the mean strain
/// gives E and nu. `surface`: for each node the sum of outward normal times area [m2] of its share
/// of the surface. Three loads, along x, y and z, on the free body, solved by conjugate gradients.
/// For a model of several materials the result is a mean without a reference value.
///
/// Throws InputError for a number of areas other than N, areas that do not close the surface, and a
/// model that is not solid (the iteration does not converge).
SurfaceStretchResult surface_stretch(const MassSpringModel& model,
                                     const std::vector<Vec3>& surface);

// Measured on a network without a surface (periodic.cpp).

/// A network of springs that repeats periodically along x, y and z: N nodes and S springs in one
/// box. Without a surface, it shows the moduli of the bulk material.
struct PeriodicNetwork {
  Vec3 box = Vec3::Ones();          ///< edges [m]
  std::vector<Vec3> rest;           ///< positions [m] N
  std::vector<std::uint32_t> a, b;  ///< ends S
  std::vector<Vec3> span;           ///< from a to the joined image of b [m] S
  std::vector<double> stiffness;    ///< k [N/m] S
};

/// Moduli of a network, averaged over all directions.
struct PeriodicModuli {
  double young = 0;      ///< E [Pa]
  double poisson = 0;    ///< nu
  double eq2_young = 0;  ///< E by eq. 2, for affine motion of all nodes [Pa]
};

/// Moduli of a periodic network. For each of the six strains of the box the nodes are relaxed to
/// equilibrium by conjugate gradients; the 6 x 6 stiffness gives the isotropic averages of Voigt
/// (1889). Throws InputError for arrays of inconsistent sizes, and if the iteration does not
/// converge.
PeriodicModuli periodic_stretch(const PeriodicNetwork& network);

}  // namespace springlod::elastic
