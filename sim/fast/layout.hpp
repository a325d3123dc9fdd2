#pragma once

#include "base/choice.hpp"

namespace springlod {

/// How the springs of a model are laid out for speed.
enum class Layout {
  fastest,   ///< in rows if it is a lattice, in quads if not
  any_shape  ///< in quads whatever it is: so that bodies are timed by one kernel
};

inline constexpr Choice<Layout> kLayouts[] = {
    {Layout::fastest, "fastest", "rows for a lattice, quads for any other model"},
    {Layout::any_shape, "any shape",
     "quads for a lattice too, to time a lattice and its levels by one kernel"}};
constexpr ChoiceTable<Choice<Layout>> choices(Layout) {
  return {"layout", kLayouts};
}

}  // namespace springlod
