#include <utility>

#include <fmt/format.h>

#include "base/chance.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/loads.hpp"

namespace springlod::elastic {
namespace {

/// Where patches can be, and how wide they are.
class Surface {
 public:
  Surface(const MassSpringModel& model, const LocalLoadOptions& options)
      : model_(model),
        radius_(options.radius * mean_spring_length(model)),
        chosen_(model.node_count(), options.within.empty()) {
    for (const std::uint32_t i : options.within) {
      if (i >= model.node_count())
        throw InputError(fmt::format("local loads: there is no node {}; the model has {}",
                                     script_number(i), model.node_count()));
      chosen_[i] = true;
    }
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      if (model.border[i] == 0) continue;
      border_.push_back(i);
      if (chosen_[i]) middles_.push_back(i);
    }
    if (middles_.empty())
      throw InputError(
          options.within.empty()
              ? "local loads: the model has no border nodes to push at"
              : "local loads: none of the nodes chosen is a border node to push at; choose "
                "nodes of the surface");
    find_normals();
  }

  /// The middle of a patch.
  std::uint32_t any(ChanceStream& chance) const {
    return middles_[chance.below(static_cast<std::uint32_t>(middles_.size()))];
  }

  /// Shares `force` among the border nodes around `center`; a patch does not reach across the edge
  /// of what is chosen.
  void pull(std::uint32_t center, const Vec3& force, StaticLoad& load) const {
    std::vector<std::uint32_t> patch;
    for (const std::uint32_t i : border_)
      if (chosen_[i] == chosen_[center] &&
          (i == center || (model_.rest[i] - model_.rest[center]).norm() <= radius_))
        patch.push_back(i);
    for (const std::uint32_t i : patch) load.force[i] += force / static_cast<double>(patch.size());
  }

  /// The border node nearest to the line that goes from `from` into the body, a patch or more away;
  /// `from` itself if there is none.
  std::uint32_t opposite(std::uint32_t from) const {
    std::uint32_t best = from;
    double nearest = 0;
    for (const std::uint32_t i : border_) {
      const Vec3 way = model_.rest[i] - model_.rest[from];
      const double depth = -way.dot(normal_[from]);
      if (depth < radius_) continue;
      const double aside = (way + depth * normal_[from]).norm();
      // Of two on the line the nearer is what the patch squeezes.
      const double distance = aside + depth;
      if (aside > radius_ || (best != from && distance >= nearest)) continue;
      best = i;
      nearest = distance;
    }
    return best;
  }

  double radius() const { return radius_; }

 private:
  /// Away from where the springs of the patch lead.
  void find_normals() {
    normal_.assign(model_.node_count(), Vec3::Zero());
    for (std::uint32_t s = 0; s < model_.spring_count(); ++s) {
      const Vec3 way = model_.rest[model_.b[s]] - model_.rest[model_.a[s]];
      normal_[model_.a[s]] -= way;
      normal_[model_.b[s]] += way;
    }
    for (Vec3& normal : normal_) normal.normalize();
  }

  const MassSpringModel& model_;
  double radius_;             // of a patch [m]
  std::vector<bool> chosen_;  // N
  std::vector<std::uint32_t> border_;
  std::vector<std::uint32_t> middles_;  // the chosen ones of them
  std::vector<Vec3> normal_;            // N, length 1, or 0 where the springs cancel out
};

/// Evenly over the sphere.
Vec3 any_direction(ChanceStream& chance) {
  constexpr double kTooShort = 0.1;  // to be stretched to length 1 without losing digits
  for (;;) {
    Vec3 way;
    for (int d = 0; d < 3; ++d) way[d] = 2 * chance.unit() - 1;
    const double length = way.norm();
    if (length <= 1 && length > kTooShort) return way / length;
  }
}

/// Draws so often for each load wanted before a body counts as too small for more.
constexpr std::uint32_t kTries = 100;

/// Up to `count` loads of those that draw(number, load) fills in; it returns false if a draw was no
/// good.
template <class Draw>
std::vector<StaticLoad> draw_loads(const MassSpringModel& model, std::uint32_t count,
                                   const char* name, const Draw& draw) {
  std::vector<StaticLoad> loads;
  for (std::uint32_t tries = 0; loads.size() < count && tries < kTries * count; ++tries) {
    StaticLoad load{fmt::format("{} {}", name, loads.size() + 1),
                    std::vector<Vec3>(model.node_count(), Vec3::Zero())};
    if (draw(loads.size(), load)) loads.push_back(std::move(load));
  }
  return loads;
}

}  // namespace

std::vector<StaticLoad> patch_pairs(const MassSpringModel& model, const LocalLoadOptions& options) {
  const Surface surface(model, options);
  ChanceStream chance(options.seed);
  return draw_loads(model, options.count, "patches", [&](std::size_t number, StaticLoad& load) {
    const std::uint32_t p = surface.any(chance);
    const std::uint32_t q = surface.any(chance);
    const bool near = number % 2 == 1;
    const bool along = chance.unit() < 0.5;
    const Vec3 apart = model.rest[q] - model.rest[p];
    const double distance = apart.norm();
    if (p == q || distance < surface.radius()) return false;
    if (near && distance > 2 * surface.radius()) return false;
    const Vec3 way = along ? Vec3(apart / distance) : any_direction(chance);
    surface.pull(p, -way, load);
    surface.pull(q, way, load);
    return true;
  });
}

std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options) {
  const Surface surface(model, options);
  ChanceStream chance(options.seed);
  return draw_loads(model, options.count, "pinch", [&](std::size_t, StaticLoad& load) {
    const std::uint32_t p = surface.any(chance);
    const std::uint32_t q = surface.opposite(p);
    if (p == q) return false;
    const Vec3 across = (model.rest[q] - model.rest[p]).normalized();
    surface.pull(p, across, load);
    surface.pull(q, -across, load);
    return true;
  });
}

std::vector<StaticLoad> pushes(const MassSpringModel& model, const LocalLoadOptions& options) {
  const Surface surface(model, options);
  ChanceStream chance(options.seed);
  return draw_loads(model, options.count, "push", [&](std::size_t, StaticLoad& load) {
    const std::uint32_t p = surface.any(chance);
    surface.pull(p, any_direction(chance), load);
    return true;
  });
}

}  // namespace springlod::elastic
