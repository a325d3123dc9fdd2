#include "lod/quality/compliance_change.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/stiffness.hpp"
#include "lod/group_means.hpp"
#include "lod/transfer.hpp"

namespace springlod::lod {
namespace {

Binding make_binding(const MergedPair& pair) {
  return fine_from_coarse(pair.fine, pair.coarse, pair.groups);
}

/// Contribution of one spring to x.Ky [J].
double work(const MassSpringModel& model, std::uint32_t spring, const std::vector<Vec3>& x,
            const std::vector<Vec3>& y) {
  const Vec3 along = spring_direction(model, spring);
  const std::uint32_t a = model.a[spring], b = model.b[spring];
  return model.stiffness[spring] * along.dot(x[b] - x[a]) * along.dot(y[b] - y[a]);
}

/// Contribution of one dilatation term to x.Ky [J].
double term_work(const DilatationTerms& terms, std::uint32_t term, const std::vector<Vec3>& x,
                 const std::vector<Vec3>& y) {
  return terms.modulus[term] * linear_dilatation(terms, term, x) *
         linear_dilatation(terms, term, y);
}

/// Contributions of the coarse nodes to the change of compliance of one load.
class Contributions {
 public:
  explicit Contributions(const MergedPair& pair)
      : pair_(pair), fine_from_coarse_(make_binding(pair)), members_(pair.groups.count, 0) {
    for (const std::uint32_t g : pair.groups.of) ++members_[g];
  }

  std::vector<double> of(const std::vector<Vec3>& u, const std::vector<Vec3>& coarse_u) const {
    const std::vector<Vec3> v = interpolate(fine_from_coarse_, coarse_u);
    const std::vector<Vec3> w = group_means(u, pair_.fine.mass, pair_.groups);
    std::vector<double> contribution(pair_.groups.count, 0);
    for (std::uint32_t s = 0; s < pair_.fine.spring_count(); ++s)
      share(pair_.groups.of[pair_.fine.a[s]], pair_.groups.of[pair_.fine.b[s]],
            work(pair_.fine, s, u, v), contribution);
    for (std::uint32_t s = 0; s < pair_.coarse.spring_count(); ++s)
      share(pair_.coarse.a[s], pair_.coarse.b[s], -work(pair_.coarse, s, w, coarse_u),
            contribution);
    const DilatationTerms& fine = pair_.fine.dilatation;
    for (std::uint32_t t = 0; t < fine.count(); ++t)
      share_term(
          fine, t, term_work(fine, t, u, v),
          [&](std::uint32_t node) { return pair_.groups.of[node]; }, contribution);
    const DilatationTerms& coarse = pair_.coarse.dilatation;
    for (std::uint32_t t = 0; t < coarse.count(); ++t)
      share_term(
          coarse, t, -term_work(coarse, t, w, coarse_u), [](std::uint32_t node) { return node; },
          contribution);
    std::vector<Vec3> force;
    elastic::apply_stiffness(pair_.fine, u, force);
    for (std::uint32_t i = 0; i < pair_.fine.node_count(); ++i)
      contribution[pair_.groups.of[i]] -= force[i].dot(u[i] + v[i]);
    elastic::apply_stiffness(pair_.coarse, coarse_u, force);
    for (std::uint32_t g = 0; g < pair_.groups.count; ++g)
      contribution[g] += force[g].dot(coarse_u[g] + w[g]);
    return contribution;
  }

 private:
  void share(std::uint32_t a, std::uint32_t b, double amount,
             std::vector<double>& contribution) const {
    const bool only_a = members_[a] > 1 && members_[b] == 1;
    const bool only_b = members_[b] > 1 && members_[a] == 1;
    constexpr double kHalf = 0.5;
    const double of_a = only_a ? 1 : only_b ? 0 : kHalf;
    contribution[a] += of_a * amount;
    contribution[b] += (1 - of_a) * amount;
  }

  /// In equal parts for the nodes of the term whose groups have several nodes, or for all of them
  /// if none or all have.
  template <class GroupOf>
  void share_term(const DilatationTerms& terms, std::uint32_t term, double amount,
                  const GroupOf& group_of, std::vector<double>& contribution) const {
    const auto nodes = terms.nodes(term);
    const auto several = [&](std::uint32_t node) { return members_[group_of(node)] > 1; };
    auto count = static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), several));
    const bool all = count == 0;
    if (all) count = nodes.size();
    for (const std::uint32_t node : nodes)
      if (all || several(node)) contribution[group_of(node)] += amount / static_cast<double>(count);
  }

  MergedPair pair_;
  Binding fine_from_coarse_;
  std::vector<std::uint32_t> members_;  // fine nodes of each coarse one
};

}  // namespace

std::vector<std::vector<double>> compliance_changes(const MergedPair& pair,
                                                    const std::vector<std::vector<Vec3>>& fine,
                                                    const std::vector<std::vector<Vec3>>& coarse) {
  if (fine.size() != coarse.size())
    throw InputError(
        fmt::format("compliance change: the fine model has {} loads, the coarse one {}",
                    fine.size(), coarse.size()));
  const Contributions contributions(pair);
  std::vector<std::vector<double>> changes;
  for (std::size_t load = 0; load < fine.size(); ++load) {
    if (fine[load].size() != pair.fine.node_count() ||
        coarse[load].size() != pair.coarse.node_count())
      throw InputError(fmt::format(
          "compliance change: load {} has displacements of {} and {} nodes; the models have {} and "
          "{} nodes",
          script_number(load), fine[load].size(), coarse[load].size(), pair.fine.node_count(),
          pair.coarse.node_count()));
    changes.push_back(contributions.of(fine[load], coarse[load]));
  }
  return changes;
}

}  // namespace springlod::lod
