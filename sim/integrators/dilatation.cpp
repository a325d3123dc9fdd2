#include "sim/integrators/dilatation.hpp"

namespace springlod::sim {

template <bool with_damping>
void add_dilatation_forces(const DilatationTerms& terms, const std::vector<Vec3>& x,
                           const std::vector<Vec3>& v, std::vector<Vec3>& force,
                           std::vector<Vec3>& damping_force) {
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const VolumeRatio ratio = volume_ratio(mean_gradient(terms, t, x));
    const Dilatation eps = dilatation(ratio.value, terms.modulus[t]);
    const double rate =
        eps.slope * ratio.by_gradient.cwiseProduct(mean_gradient(terms, t, v)).sum();
    const double damping = terms.modulus[t] * terms.damping_time[t] * rate;
    const double stress = terms.modulus[t] * eps.strain + damping;
    const Mat3 by_gradient = eps.slope * ratio.by_gradient;
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e) {
      const Vec3 by_node = by_gradient * terms.gradient[e];
      force[terms.node[e]] -= stress * by_node;
      if constexpr (with_damping) damping_force[terms.node[e]] -= damping * by_node;
    }
  }
}

template void add_dilatation_forces<true>(const DilatationTerms&, const std::vector<Vec3>&,
                                          const std::vector<Vec3>&, std::vector<Vec3>&,
                                          std::vector<Vec3>&);
template void add_dilatation_forces<false>(const DilatationTerms&, const std::vector<Vec3>&,
                                           const std::vector<Vec3>&, std::vector<Vec3>&,
                                           std::vector<Vec3>&);

}  // namespace springlod::sim
