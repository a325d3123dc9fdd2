#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod {

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

}  // namespace springlod
