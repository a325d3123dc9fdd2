#pragma once

#include <string>
#include <string_view>

#include "base/range.hpp"
#include "base/units.hpp"
#include "model/vec.hpp"

struct lua_State;

namespace springlod::scripting {

// Texts, numbers and vectors on the stack of Lua, and what messages say of them.

/// The string at `index`, including zero bytes.
std::string text_at(lua_State* L, int index);
/// Description of an invalid value for messages: "\"two\"", "1.5", "a table".
std::string shown(lua_State* L, int index);
/// "from 0 mm to 1 mm, got 2 mm".
std::string range_text(const Range& range, Dimension dimension, double value);

/// A number, or text with a unit, at `index`. Throws InputError naming `what`.
double quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what);
/// The same within kUsualNumbers.
double usual_quantity_at(lua_State* L, int index, Dimension dimension, std::string_view what);
/// {x, y, z} of quantities at `index`, within kUsualNumbers.
Vec3 vector_at(lua_State* L, int index, Dimension dimension, std::string_view what);

}  // namespace springlod::scripting
