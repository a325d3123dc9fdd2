#pragma once

#include "model/mass_spring.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// A model from plain tables: nodes, springs, corners, materials (the options of `s.model`).
/// Springs and corners may come in any order and direction. Throws InputError naming the entry.
MassSpringModel model_from_tables(Call& call, TableReader& options);

/// {x=, y=, z=, mass=, ...} of a node, {a=, b=, k=, ...} of a spring, {nodes=, young=, volume=} of
/// a corner; `number` counts from 0, numbers in the table from 1.
void push_node(lua_State* L, const MassSpringModel& model, std::uint32_t number);
void push_spring(lua_State* L, const MassSpringModel& model, std::uint32_t number);
void push_corner(lua_State* L, const MassSpringModel& model, std::uint32_t number);

/// The records Node, Spring and Corner.
void describe_model_tables(Api& api);

}  // namespace springlod::scripting
