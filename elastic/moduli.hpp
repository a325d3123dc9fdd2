#pragma once

#include <cstdint>
#include <vector>

#include "elastic/loads.hpp"
#include "model/mass_spring.hpp"
#include "model/vec.hpp"

// Elastic moduli that a model shows, estimated or measured: the face of moduli/.
namespace springlod::elastic {

// Estimated by eq. 2 of the paper (estimate.cpp).

/// What eq. 2 of the paper says of some nodes of a model: with W = sum of k L^2 over their springs,
/// a spring counted half at either end, and V their volume, E = W / (6 V), lambda = mu = W / (15 V)
/// and K = W / (9 V).
struct Eq2Estimate {
  std::uint32_t nodes = 0;
  double mass = 0;     ///< [kg]
  double volume = 0;   ///< [m3]
  double work = 0;     ///< W [N m]
  double density = 0;  ///< [kg/m3]
  double young = 0;    ///< E [Pa]
  double shear = 0;    ///< mu, and Lame's lambda [Pa]
  double bulk = 0;     ///< K [Pa]
};

struct ModelEstimate {
  Eq2Estimate whole;
  /// One for each of model.materials, of the nodes that have it; all 0 if none has.
  std::vector<Eq2Estimate> materials;
  std::vector<double> young;    ///< of each node [Pa] N
  std::vector<double> density;  ///< of each node [kg/m3] N
};

/// An upper bound, as the nodes need not move affinely; stretch_test measures. Springs across a
/// joint belong half to the material of each end, so that they blur what is told of either.
ModelEstimate estimate(const MassSpringModel& model);

// Measured from solved loads, by material (measured_moduli.cpp).

/// Moduli that one material of a model shows.
struct MaterialModuli {
  std::uint32_t material = 0;  ///< number in the model's list
  double young = 0;            ///< E [Pa]
  double poisson = 0;          ///< nu
  double volume = 0;           ///< of its nodes [m3]
};

/// E and nu of each material from how the model gives way to loads: the isotropic law nearest to
/// the volume averages of stress (virial of the springs, one between two materials half to each)
/// and strain (of each node from its springs within the material), every solution of the same
/// weight. Solutions that strain a material to and fro (bends, twists) have averages near zero and
/// are left out for it.
///
/// Within 1 % for one material on a lattice; within some percent where much of a material lies at
/// its border with another, whose strain its nodes there share.
///
/// Materials that this tells nothing of are not in the list: no node, most of the volume in nodes
/// whose springs within the material lie in a plane, or no solution that strains it.
/// Throws InputError for displacements of another size than N.
std::vector<MaterialModuli> measured_moduli(const MassSpringModel& model,
                                            const std::vector<StaticSolution>& solutions);

// Measured by pulling the surface of a body of any shape (surface_stretch.cpp).

/// What a body of any shape shows when its surface is pulled as in uniform stress.
struct SurfaceStretchResult {
  double young = 0;    ///< mean over x, y, z [Pa]
  double poisson = 0;  ///< mean over the six pairs of axes
};

/// A stretch test for any shape: under surface tractions sigma n a body of one material is in
/// uniform stress sigma wherever its surface runs, so that the work of the tractions tells E and nu
/// (as the virial gives the mean stress; Nemat-Nasser & Hori 1999, sect. 2). `surface` holds for
/// each node the sum of outward normal times area [m2] of the surface it stands for. Three pulls,
/// along x, y and z, each solved by conjugate gradients with no node held. For a model of several
/// materials the result is a mean without a target to compare with.
///
/// Throws InputError: other than one area a node, areas that do not close the surface, a model that
/// is not solid (the iteration does not converge).
SurfaceStretchResult surface_stretch(const MassSpringModel& model,
                                     const std::vector<Vec3>& surface);

// Measured on a network without a surface (periodic.cpp).

/// A network of springs that repeats itself along x, y and z: N nodes and S springs of one box. It
/// has no surface, so it shows what a material made of such springs does.
struct PeriodicNetwork {
  Vec3 box = Vec3::Ones();          ///< edges [m]
  std::vector<Vec3> rest;           ///< positions [m] N
  std::vector<std::uint32_t> a, b;  ///< ends S
  std::vector<Vec3> span;           ///< from a to the image of b that is meant [m] S
  std::vector<double> stiffness;    ///< k [N/m] S
};

/// Moduli of a network, averaged over all directions.
struct PeriodicModuli {
  double young = 0;      ///< E [Pa]
  double poisson = 0;    ///< nu
  double eq2_young = 0;  ///< E by eq. 2 of the paper, if all nodes moved affinely [Pa]
};

/// The six strains of the box, each with the nodes relaxed to equilibrium (conjugate gradients);
/// from the 6 x 6 stiffness the isotropic averages of Voigt (1889). Throws InputError for arrays
/// that do not fit each other, and should the iteration not converge.
PeriodicModuli periodic_stretch(const PeriodicNetwork& network);

}  // namespace springlod::elastic
