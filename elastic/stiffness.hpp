#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Stiffness matrix at rest, 3N x 3N [N/m]; node i has the rows 3i..3i+2 (docs/method.md, eq. 11).
/// Symmetric; both triangles are stored.
Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model);

/// f = K u without assembling K: N displacements u [m], N forces f [N]. Throws InputError for
/// displacements of a size other than N.
void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f);

}  // namespace springlod::elastic
