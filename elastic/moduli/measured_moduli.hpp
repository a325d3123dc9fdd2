#pragma once

#include <cstdint>
#include <vector>

#include "elastic/loads/static_loads.hpp"
#include "model/mass_spring.hpp"

namespace springlod {

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

}  // namespace springlod
