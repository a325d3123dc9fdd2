#include "scripting/bind/tables/run_options.hpp"

namespace springlod::scripting {

Parameter contact_parameter() {
  return {.name = "contact",
          .type = "one of",
          .fallback = "\"nodes\"",
          .help = "contact points of a level",
          .choices = words_of<sim::ContactAt>()};
}

sim::ContactAt read_contact(TableReader& reader) {
  sim::ContactAt contact = sim::ContactAt::nodes;
  reader.read("contact", contact);
  return contact;
}

std::shared_ptr<const sim::ContactSkin> skin_of(const ModelValue& model, sim::ContactAt contact) {
  if (contact == sim::ContactAt::nodes || !model.chain || model.level == 0) return nullptr;
  return std::make_shared<sim::ContactSkin>(sim::contact_skin(model.chain->chain, model.level));
}

}  // namespace springlod::scripting
