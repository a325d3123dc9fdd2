#include "lod/group_means.hpp"

namespace springlod::lod {

std::vector<Vec3> group_means(const std::vector<Vec3>& field, const std::vector<double>& mass,
                              const Groups& groups) {
  std::vector<Vec3> sum(groups.count, Vec3::Zero());
  std::vector<double> weight(groups.count, 0);
  for (std::size_t i = 0; i < field.size(); ++i) {
    sum[groups.of[i]] += mass[i] * field[i];
    weight[groups.of[i]] += mass[i];
  }
  for (std::size_t g = 0; g < sum.size(); ++g) sum[g] /= weight[g];
  return sum;
}

double work_on_means(const std::vector<Vec3>& force, const std::vector<Vec3>& displacement,
                     const std::vector<double>& mass, const Groups& groups) {
  const std::vector<Vec3> means = group_means(displacement, mass, groups);
  double work = 0;
  for (std::size_t i = 0; i < force.size(); ++i) work += force[i].dot(means[groups.of[i]]);
  return work;
}

}  // namespace springlod::lod
