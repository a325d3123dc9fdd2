#include "elastic/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "elastic/assembly.hpp"

namespace springlod::elastic {
namespace {

/// A dilatation term at some positions.
struct TermState {
  Mat3 gradient;       // F
  Mat3 volume_slope;   // derivative of J by F
  Dilatation law;      // eps and its slope
  double curvature{};  // second derivative of eps by J
};

/// Second derivative of the law of `dilatation` by J.
double curvature_of(double volume_ratio, double modulus) {
  if (modulus > 0) return 0;
  const double change = volume_ratio - 1;
  return -3 * change * std::pow(1 + change * change, -2.5);
}

TermState state_of(const DilatationTerms& terms, std::uint32_t t, const std::vector<Vec3>& x) {
  TermState state;
  state.gradient = mean_gradient(terms, t, x);
  const VolumeRatio ratio = volume_ratio(state.gradient);
  state.volume_slope = ratio.by_gradient;
  state.law = dilatation(ratio.value, terms.modulus[t]);
  state.curvature = curvature_of(ratio.value, terms.modulus[t]);
  return state;
}

Mat3 cross_matrix(const Vec3& v) {
  return (Mat3() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

/// Second derivative of the energy of a term by the positions of two of its nodes, whose gradients
/// are p (rows) and q (columns). That of J = det F, for displacements u of the first and v of the
/// second, is (u x v) . F (p x q).
Mat3 block_of(const TermState& state, double modulus, const Vec3& p, const Vec3& q,
              Tangent tangent) {
  const Vec3 row = state.volume_slope * p;
  const Vec3 column = state.volume_slope * q;
  double both = state.law.slope * state.law.slope;
  if (tangent == Tangent::convex) return modulus * both * row * column.transpose();
  both += state.law.strain * state.curvature;
  const Mat3 turning = cross_matrix(state.gradient * p.cross(q)).transpose();
  return modulus * (both * row * column.transpose() + state.law.strain * state.law.slope * turning);
}

/// Second derivative of the energy of a spring by the position of one of its ends.
Mat3 block_of_spring(const MassSpringModel& model, std::uint32_t s, const std::vector<Vec3>& x,
                     Tangent tangent) {
  const Vec3 along = x[model.b[s]] - x[model.a[s]];
  const double length = along.norm();
  const double k = model.stiffness[s];
  if (!(length > 0)) return k * Mat3::Identity();
  const Vec3 unit = along / length;
  double across = k * (1 - model.rest_length[s] / length);
  if (tangent == Tangent::convex) across = std::max(0.0, across);
  const Mat3 axis = unit * unit.transpose();
  return k * axis + across * (Mat3::Identity() - axis);
}

}  // namespace

double strain_energy(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double energy = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double stretch = (x[model.b[s]] - x[model.a[s]]).norm() - model.rest_length[s];
    energy += 0.5 * model.stiffness[s] * stretch * stretch;
  }
  return energy + dilatation_energy(model.dilatation, x);
}

std::vector<Vec3> holding_forces(const MassSpringModel& model, const std::vector<Vec3>& x) {
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 along = x[model.b[s]] - x[model.a[s]];
    const double length = along.norm();
    if (!(length > 0)) continue;
    const Vec3 pull = model.stiffness[s] * (length - model.rest_length[s]) / length * along;
    force[model.a[s]] -= pull;
    force[model.b[s]] += pull;
  }
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const TermState state = state_of(terms, t, x);
    const Mat3 stress = terms.modulus[t] * state.law.strain * state.law.slope * state.volume_slope;
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      force[terms.node[e]] += stress * terms.gradient[e];
  }
  return force;
}

Eigen::SparseMatrix<double> tangent_matrix(const MassSpringModel& model, const std::vector<Vec3>& x,
                                           Tangent tangent) {
  const DilatationTerms& terms = model.dilatation;
  std::vector<TermState> states;
  states.reserve(terms.count());
  for (std::uint32_t t = 0; t < terms.count(); ++t) states.push_back(state_of(terms, t, x));
  return assemble(
      model, [&](std::uint32_t s) { return block_of_spring(model, s, x, tangent); },
      [&](std::uint32_t t, std::uint32_t row, std::uint32_t column) {
        return block_of(states[t], terms.modulus[t], terms.gradient[row], terms.gradient[column],
                        tangent);
      });
}

}  // namespace springlod::elastic
