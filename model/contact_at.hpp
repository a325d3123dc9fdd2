#pragma once

#include "base/choice.hpp"

namespace springlod::inline model {

/// Points at which the levels of a chain touch obstacles.
enum class ContactAt {
  nodes,   ///< the level's own nodes
  surface  ///< points of the base's surface: see sim/contact/contact_skin.hpp
};

inline constexpr Choice<ContactAt> kContacts[] = {
    {ContactAt::nodes, "nodes", "the level's own nodes, which lie inside the base's surface"},
    {ContactAt::surface, "surface",
     "points of the base's surface, interpolated from the level's nodes"}};
constexpr ChoiceTable<Choice<ContactAt>> choices(ContactAt) {
  return {"contact", kContacts};
}

}  // namespace springlod::inline model
