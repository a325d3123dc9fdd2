#include "elastic/moduli.hpp"

namespace springlod::elastic {
namespace {

void finish(Eq2Estimate& e) {
  if (e.nodes == 0) return;
  e.density = e.mass / e.volume;
  e.young = affine_young(e.work, e.dilatation, e.volume);
  e.shear = e.work / (15 * e.volume);
  e.bulk = e.work / (9 * e.volume) + e.dilatation / e.volume;
}

void add_node(const MassSpringModel& model, std::uint32_t node, double work, double dilatation,
              Eq2Estimate& to) {
  ++to.nodes;
  to.mass += model.mass[node];
  to.volume += model.volume[node];
  to.work += work;
  to.dilatation += dilatation;
}

}  // namespace

ModelEstimate estimate(const MassSpringModel& model) {
  std::vector<double> work(model.node_count(), 0);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double half = model.stiffness[s] * model.rest_length[s] * model.rest_length[s] / 2;
    work[model.a[s]] += half;
    work[model.b[s]] += half;
  }
  const std::vector<double> dilatation = dilatation_shares(model).modulus;
  ModelEstimate result;
  result.materials.resize(model.materials.size());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    add_node(model, i, work[i], dilatation[i], result.whole);
    add_node(model, i, work[i], dilatation[i], result.materials[model.material[i]]);
    result.young.push_back(affine_young(work[i], dilatation[i], model.volume[i]));
    result.density.push_back(model.mass[i] / model.volume[i]);
  }
  finish(result.whole);
  for (Eq2Estimate& material : result.materials) finish(material);
  return result;
}

}  // namespace springlod::elastic
