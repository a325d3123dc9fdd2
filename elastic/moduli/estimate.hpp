#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod {

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

}  // namespace springlod
