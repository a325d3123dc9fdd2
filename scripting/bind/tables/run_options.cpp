#include "scripting/bind/tables/run_options.hpp"

#include <fmt/format.h>

#include "base/units.hpp"

namespace springlod::scripting {

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

std::string inversion_hint(bool resisted) {
  if (resisted) return "use a stiffer material, a slower impact or a smaller step";
  return "keep the corners of the model (volumes = true) and take an explicit integrator, use a "
         "stiffer material or a slower impact";
}

}  // namespace springlod::scripting
