#include "elastic/stiffness.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/assembly.hpp"

namespace springlod::elastic {

Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model) {
  const DilatationTerms& terms = model.dilatation;
  return assemble(
      model,
      [&](std::uint32_t s) -> Mat3 {
        const Vec3 u = spring_direction(model, s);
        return model.stiffness[s] * u * u.transpose();
      },
      [&](std::uint32_t t, std::uint32_t row, std::uint32_t column) -> Mat3 {
        const Vec3 pressure = terms.modulus[t] * terms.gradient[column];
        return terms.gradient[row] * pressure.transpose();
      });
}

void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f) {
  if (u.size() != model.rest.size())
    throw InputError(
        fmt::format("stiffness: {} displacements for {} nodes", u.size(), model.rest.size()));
  f.assign(model.rest.size(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 direction = spring_direction(model, s);
    const Vec3 tension =
        model.stiffness[s] * direction.dot(u[model.b[s]] - u[model.a[s]]) * direction;
    f[model.a[s]] -= tension;
    f[model.b[s]] += tension;
  }
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const double stress = terms.modulus[t] * linear_dilatation(terms, t, u);
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      f[terms.node[e]] += stress * terms.gradient[e];
  }
}

}  // namespace springlod::elastic
