#pragma once

#include <vector>

#include "model/mass_spring.hpp"

namespace springlod {

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

}  // namespace springlod
