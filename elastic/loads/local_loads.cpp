#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/script_number.hpp"
#include "elastic/loads.hpp"

namespace springlod::elastic {
namespace {

/// The border nodes, and the patches around them.
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
              ? "local loads: the model has no border nodes; mark the nodes of its surface"
              : "local loads: none of the chosen nodes is a border node; choose nodes of the "
                "surface");
    find_normals();
  }

  /// A random centre of a patch.
  std::uint32_t any(RandomStream& random) const {
    return middles_[random.below(static_cast<std::uint32_t>(middles_.size()))];
  }

  /// Distributes `force` over the border nodes around `center`. A patch ends at the boundary of the
  /// chosen nodes.
  void pull(std::uint32_t center, const Vec3& force, StaticLoad& load) const {
    std::vector<std::uint32_t> patch;
    double area = 0;
    for (const std::uint32_t i : border_)
      if (chosen_[i] == chosen_[center] &&
          (i == center || (model_.rest[i] - model_.rest[center]).norm() <= radius_)) {
        patch.push_back(i);
        area += model_.contact_area[i];
      }
    // The border nodes of cut cells lie on both sides of the surface; the outermost ones are light
    // and soft, and bear as little as they have of its area.
    const bool by_area = !model_.surface.empty() && area > 0;
    for (const std::uint32_t i : patch)
      if (by_area)
        load.force[i] += model_.contact_area[i] / area * force;
      else
        load.force[i] += force / static_cast<double>(patch.size());
  }

  /// The border node nearest to the line from `from` into the body, at least a patch radius away;
  /// `from` itself if there is none.
  std::uint32_t opposite(std::uint32_t from) const {
    std::uint32_t best = from;
    double nearest = 0;
    for (const std::uint32_t i : border_) {
      const Vec3 offset = model_.rest[i] - model_.rest[from];
      const double depth = -offset.dot(normal_[from]);
      if (depth < radius_) continue;
      const double aside = (offset + depth * normal_[from]).norm();
      // Of several candidates the nearest counts: it is on the other side of the same wall.
      const double distance = aside + depth;
      if (aside > radius_ || (best != from && distance >= nearest)) continue;
      best = i;
      nearest = distance;
    }
    return best;
  }

  double radius() const { return radius_; }

 private:
  /// The normal of a node is the negative sum of its spring vectors, normalized.
  void find_normals() {
    normal_.assign(model_.node_count(), Vec3::Zero());
    for (std::uint32_t s = 0; s < model_.spring_count(); ++s) {
      const Vec3 span = model_.rest[model_.b[s]] - model_.rest[model_.a[s]];
      normal_[model_.a[s]] -= span;
      normal_[model_.b[s]] += span;
    }
    for (Vec3& normal : normal_) normal.normalize();
  }

  const MassSpringModel& model_;
  double radius_;             // of a patch [m]
  std::vector<bool> chosen_;  // N
  std::vector<std::uint32_t> border_;
  std::vector<std::uint32_t> middles_;  // the chosen border nodes
  std::vector<Vec3> normal_;            // N, of length 1, or 0 if the springs cancel out
};

/// A direction uniformly distributed over the sphere.
Vec3 any_direction(RandomStream& random) {
  constexpr double kTooShort = 0.1;  // shorter vectors lose digits when normalized
  for (;;) {
    Vec3 direction;
    for (int d = 0; d < 3; ++d) direction[d] = 2 * random.unit() - 1;
    const double length = direction.norm();
    if (length <= 1 && length > kTooShort) return direction / length;
  }
}

/// Most draws for each requested load; then the surface counts as too small for more.
constexpr std::uint32_t kTries = 100;

/// Up to `count` loads filled in by draw(number, load), which returns false for an unusable draw.
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
  RandomStream random(options.seed);
  return draw_loads(model, options.count, "patches", [&](std::size_t number, StaticLoad& load) {
    const std::uint32_t p = surface.any(random);
    const std::uint32_t q = surface.any(random);
    const bool near = number % 2 == 1;
    const bool along = random.unit() < 0.5;
    const Vec3 apart = model.rest[q] - model.rest[p];
    const double distance = apart.norm();
    if (p == q || distance < surface.radius()) return false;
    if (near && distance > 2 * surface.radius()) return false;
    const Vec3 direction = along ? Vec3(apart / distance) : any_direction(random);
    surface.pull(p, -direction, load);
    surface.pull(q, direction, load);
    return true;
  });
}

std::vector<StaticLoad> pinches(const MassSpringModel& model, const LocalLoadOptions& options) {
  const Surface surface(model, options);
  RandomStream random(options.seed);
  return draw_loads(model, options.count, "pinch", [&](std::size_t, StaticLoad& load) {
    const std::uint32_t p = surface.any(random);
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
  RandomStream random(options.seed);
  return draw_loads(model, options.count, "push", [&](std::size_t, StaticLoad& load) {
    const std::uint32_t p = surface.any(random);
    surface.pull(p, any_direction(random), load);
    return true;
  });
}

}  // namespace springlod::elastic
