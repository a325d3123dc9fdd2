#include "scripting/bind/tables/run_options.hpp"

#include <cstddef>
#include <functional>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/units.hpp"

namespace springlod::scripting {

namespace {

/// Bases for which the session has printed damping_hint().
struct DampedBases {
  std::set<std::size_t> hashes;
};

/// A hash of what makes the body and its damping: an asset that is loaded again has the same one.
std::size_t hash_of(const MassSpringModel& model) {
  std::size_t sum = 0;
  const auto add = [&sum](const void* data, std::size_t bytes) {
    const std::string_view text(static_cast<const char*>(data), bytes);
    sum = 31 * sum + std::hash<std::string_view>{}(text);
  };
  add(model.rest.data(), model.rest.size() * sizeof(Vec3));
  add(model.mass.data(), model.mass.size() * sizeof(double));
  add(model.stiffness.data(), model.stiffness.size() * sizeof(double));
  add(model.damping.data(), model.damping.size() * sizeof(double));
  return sum;
}

}  // namespace

Parameter contact_parameter() {
  return {.name = "contact",
          .type = "one of",
          .fallback = "that of the chain",
          .help = "contact points of a level",
          .choices = words_of<ContactAt>()};
}

std::optional<ContactAt> read_contact(TableReader& reader) {
  std::optional<ContactAt> contact;
  reader.read("contact", contact);
  return contact;
}

std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model,
                                                std::optional<ContactAt> contact) {
  if (!model.chain || model.level == 0) return nullptr;
  if (contact.value_or(model.chain->chain.contact) == ContactAt::nodes) return nullptr;
  return model.chain->skin(model.level);
}

std::string damping_hint(const sim::Trajectory& run) {
  return fmt::format(
      "to {:.2g} % of that without damping (stable step {}, without damping {}); for a "
      "longer step, give the materials a smaller damping_ratio or a shorter damping time, or take "
      "an implicit integrator",
      100 * run.predicted_step / run.undamped_step,
      format_quantity(run.predicted_step, Dimension::time),
      format_quantity(run.undamped_step, Dimension::time));
}

bool first_hint_at_damping(Session& session, const MassSpringModel& base) {
  return session.kept<DampedBases>().hashes.insert(hash_of(base)).second;
}

std::string inversion_hint(bool resisted) {
  if (resisted) return "use a stiffer material, a slower impact or a smaller step";
  return "keep the corners of the model (volumes = true) and take an explicit integrator, use a "
         "stiffer material or a slower impact";
}

}  // namespace springlod::scripting
