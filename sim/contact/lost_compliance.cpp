#include "sim/contact/lost_compliance.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>

#include "elastic/stable_step.hpp"
#include "model/spring_rows.hpp"
#include "model/terms_of_nodes.hpp"

namespace springlod::sim {
namespace {

// Every node is tied to its place by a spring of this fraction of its mean stiffness [1]. A small
// body without held nodes does not drift off then; it changes the difference of two compliances by
// about as much.
constexpr double kTie = 0.01;
// The same for a node without springs [N/m].
constexpr double kLooseTie = 1;

// Most base nodes of a region: those of groups of up to about ten nodes. The time grows with the
// third power of this number.
constexpr std::size_t kMostNodes = 160;

/// Some nodes of a model, all others held.
class HeldRegion {
 public:
  /// `ties`: of the nodes to their places [N/m] > 0. Both must outlive this.
  HeldRegion(const MassSpringModel& model, const std::vector<double>& ties)
      : model_(&model),
        ties_(&ties),
        springs_(model),
        terms_(model),
        place_(model.node_count(), kOutside) {}

  void take(const std::vector<std::uint32_t>& nodes);
  /// Of one of the points [m/N]; its nodes outside the region do not move.
  Mat3 compliance(const Binding& points, std::uint32_t point) const;

 private:
  static constexpr Eigen::Index kOutside = -1;

  /// Adds the rows of the node in its dilatation terms.
  void add_terms(std::uint32_t node);

  const MassSpringModel* model_;
  const std::vector<double>* ties_;
  SpringRows springs_;
  TermsOfNodes terms_;
  std::vector<std::uint32_t> nodes_;
  std::vector<Eigen::Index> place_;  // of each node in the region, or kOutside
  Eigen::MatrixXd factor_;           // of the stiffness [(N/m)^1/2], lower triangle
};

void HeldRegion::add_terms(std::uint32_t node) {
  const DilatationTerms& terms = model_->dilatation;
  for (const auto& [term, own] : terms_.of(node)) {
    const Vec3 pressure = terms.modulus[term] * terms.gradient[own];
    for (std::uint32_t e = terms.start[term]; e < terms.start[term + 1]; ++e)
      if (place_[terms.node[e]] != kOutside)
        factor_.block<3, 3>(place_[node], place_[terms.node[e]]) +=
            pressure * terms.gradient[e].transpose();
  }
}

void HeldRegion::take(const std::vector<std::uint32_t>& nodes) {
  for (const std::uint32_t node : nodes_) place_[node] = kOutside;
  nodes_ = nodes;
  Eigen::Index size = 0;
  for (const std::uint32_t node : nodes_) {
    place_[node] = size;
    size += 3;
  }
  factor_.setZero(size, size);
  for (const std::uint32_t node : nodes_) {
    const Eigen::Index row = place_[node];
    auto own = factor_.block<3, 3>(row, row);
    own += (*ties_)[node] * Mat3::Identity();
    springs_.for_each(node, [&](std::uint32_t other, std::uint32_t spring) {
      const Vec3 unit = spring_direction(*model_, spring);
      const Mat3 block = model_->stiffness[spring] * unit * unit.transpose();
      own += block;
      if (place_[other] != kOutside) factor_.block<3, 3>(row, place_[other]) -= block;
    });
    add_terms(node);
  }
  // Without BLAS, whose kernels round differently on other processors: steps have the same bits on
  // all of them.
  [[maybe_unused]] const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factorised(factor_);
  assert(factorised.info() == Eigen::Success);  // by the ties
}

Mat3 HeldRegion::compliance(const Binding& points, std::uint32_t point) const {
  Eigen::MatrixX3d forces = Eigen::MatrixX3d::Zero(factor_.rows(), 3);
  for (std::uint32_t e = points.start[point]; e < points.start[point + 1]; ++e)
    if (place_[points.node[e]] != kOutside)
      forces.middleRows<3>(place_[points.node[e]]) += points.weight[e] * Mat3::Identity();
  factor_.triangularView<Eigen::Lower>().solveInPlace(forces);
  return forces.transpose() * forces;
}

/// The nodes of each group of a level.
std::vector<std::vector<std::uint32_t>> members_of(const Groups& groups) {
  std::vector<std::vector<std::uint32_t>> members(groups.count);
  for (std::uint32_t i = 0; i < groups.of.size(); ++i) members[groups.of[i]].push_back(i);
  return members;
}

}  // namespace

std::vector<std::optional<Mat3>> lost_compliance(const LodChain& chain, std::uint32_t level,
                                                 const BoundSurface& surface) {
  const MassSpringModel& base = chain.levels[0].model;
  const Level& coarse = level_at(chain, level);
  std::vector<double> ties;
  std::vector<double> coarse_ties(coarse.model.node_count(), 0);
  const std::vector<Mat3> node_stiffness = elastic::node_stiffness(base);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    const double stiffness = node_stiffness[i].trace() / 3;
    ties.push_back(stiffness > 0 ? kTie * stiffness : kLooseTie);
    coarse_ties[coarse.of_base.of[i]] += ties.back();
  }
  HeldRegion fine_region(base, ties);
  HeldRegion coarse_region(coarse.model, coarse_ties);
  const SpringRows springs(coarse.model);
  const std::vector<std::vector<std::uint32_t>> members = members_of(coarse.of_base);

  // Points of one group share a region.
  std::vector<std::uint32_t> order(surface.points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return surface.points[p].group < surface.points[q].group;
  });
  std::vector<std::optional<Mat3>> lost(surface.points.size());
  std::uint32_t taken = std::numeric_limits<std::uint32_t>::max();
  bool small = false;
  for (const std::uint32_t p : order) {
    const std::uint32_t group = surface.points[p].group;
    if (group != taken) {
      std::vector<std::uint32_t> nodes{group};
      springs.for_each(group, [&](std::uint32_t other, std::uint32_t) { nodes.push_back(other); });
      std::vector<std::uint32_t> of_base;
      for (const std::uint32_t node : nodes)
        of_base.insert(of_base.end(), members[node].begin(), members[node].end());
      taken = group;
      small = of_base.size() <= kMostNodes;
      if (small) {
        coarse_region.take(nodes);
        fine_region.take(of_base);
      }
    }
    if (small)
      lost[p] = fine_region.compliance(surface.to_base, p) -
                coarse_region.compliance(surface.to_level, p);
  }
  return lost;
}

}  // namespace springlod::sim
