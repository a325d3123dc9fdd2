#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scripting/engine/value.hpp"
#include "sweep/unit_result.hpp"

struct lua_State;

namespace springlod::scripting {

/// One of the quantities that vary between units.
struct SweepAxis {
  std::string name;
  std::vector<sweep::Cell> values;
};

/// A function of a script, kept for as long as its Lua state; 0: none.
using FunctionReference = int;

/// Units of a sweep that may run in any order: all combinations of the values of the axes, the last
/// axis varying fastest.
struct SweepStage {
  std::string name;
  std::vector<SweepAxis> axes;
  std::uint64_t units = 0;
  std::vector<std::string> columns;
  std::vector<std::string> timings;  ///< those of the columns that are measured times
  bool waits = true, alone = false;  ///< as in sweep::Stage
  FunctionReference unit = 0;
  FunctionReference cost = 0;
};

struct SweepValue {
  std::vector<SweepStage> stages;
  FunctionReference report = 0;

  std::uint64_t unit_count() const;
};
template <>
inline constexpr const char* kValueName<SweepValue> = "Sweep";

/// A unit by its stage and its number there, counted from 0.
struct SweepPlace {
  const SweepStage& stage;
  std::uint64_t number;
};
/// `unit`: of the sweep, counted from 0, less than unit_count().
SweepPlace place_of(const SweepValue& sweep, std::uint64_t unit);

/// Sets the value of each axis at a unit, by name, in the table on top.
void set_axes(lua_State* L, const SweepPlace& place);
/// Sets the cells of a row, by column, in the table on top.
void set_cells(lua_State* L, const std::vector<std::string>& columns, const sweep::Row& row);
/// A unit of a sweep, and the folder of its plan; empty: there is none.
struct SweepUnit {
  const SweepValue& sweep;
  std::uint64_t number;
  std::string folder{};
};
/// Pushes what the functions of a script are called with: the values of the axes by name, `index`,
/// `seed` and `folder`.
void push_point(lua_State* L, const SweepUnit& unit);

/// Calls the unit's function. Throws InputError with the message of a Lua error, or if the result
/// has other columns than those of the stage, InterruptedError.
std::vector<sweep::Row> run_unit(lua_State* L, const SweepUnit& unit);
/// Estimated spring updates of a unit; 1 if the stage does not estimate them. Throws as run_unit.
double cost_of(lua_State* L, const SweepUnit& unit);

}  // namespace springlod::scripting
