#include "lod/group_means.hpp"

#include <cmath>

namespace springlod::lod {
namespace {

// A smaller part of the work along the nodes' own displacements is rounding: the forces on each
// group cancel [1].
constexpr double kRounding = 1e-9;

}  // namespace

std::vector<double> group_masses(const std::vector<double>& mass, const Groups& groups) {
  std::vector<double> sum(groups.count, 0);
  for (std::size_t i = 0; i < mass.size(); ++i) sum[groups.of[i]] += mass[i];
  return sum;
}

std::vector<Vec3> group_means(const std::vector<Vec3>& field, const std::vector<double>& mass,
                              const Groups& groups) {
  std::vector<Vec3> sum(groups.count, Vec3::Zero());
  const std::vector<double> weight = group_masses(mass, groups);
  for (std::size_t i = 0; i < field.size(); ++i) sum[groups.of[i]] += mass[i] * field[i];
  for (std::size_t g = 0; g < sum.size(); ++g) sum[g] /= weight[g];
  return sum;
}

double work_on_means(const std::vector<Vec3>& force, const std::vector<Vec3>& displacement,
                     const std::vector<double>& mass, const Groups& groups) {
  const std::vector<Vec3> means = group_means(displacement, mass, groups);
  double work = 0;
  double along_nodes = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    work += force[i].dot(means[groups.of[i]]);
    along_nodes += std::abs(force[i].dot(displacement[i]));
  }
  return work > kRounding * along_nodes ? work : 0;
}

}  // namespace springlod::lod
