// Files of --materials: Lua code in the sandbox, and the table that it returns. What is accepted is
// used: a material that passes the checks must not poison a run.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "scripting/bind/topics.hpp"
#include "scripting/engine/state.hpp"
#include "tests/fuzz/deadline.hpp"

namespace {

// The file may change whatever is global: what is needed after it is local before it.
constexpr const char* kUse = R"lua(
local s = require "springlod"
local load, pcall, type, next, error = load, pcall, type, next, error
os.exit = nil
local text = ...
local chunk = load(text, "=materials", "t")
if not chunk then return end
local run, materials = pcall(chunk)
if not run or type(materials) ~= "table" then return end
local used, failure = pcall(function()
  local name = next(materials)
  local grid = s.grid{cell = 0.1, size = {2, 1, 1}, materials = materials,
                      fill = function() return name end}
  local model = s.lattice(grid)
  s.run(model, {duration = 5 * s.stable_step(model)}, {frame_rate = 0, quiet = true})
end)
if not used and type(failure) == "userdata" then
  local bugs = {internal = true, memory = true}
  if bugs[failure.kind] then error(failure, 0) end
end
)lua";

constexpr std::uint64_t kMemory = 256'000'000;  // [bytes]

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const springlod::scripting::InterruptHandler interrupts;
  // A state for each input: a file may break the one that it runs in.
  springlod::scripting::ScriptState state(
      {.verbosity = springlod::scripting::Verbosity::quiet, .script_memory = kMemory},
      springlod::scripting::make_api());
  state.session().files().restrict();
  const springlod::fuzz::Deadline deadline;
  const springlod::scripting::Outcome outcome =
      state.run_text(kUse, "use", {std::string(reinterpret_cast<const char*>(data), size)});
  if (outcome.done || outcome.interrupted) return 0;
  std::fprintf(stderr, "no clear refusal: %s\n", outcome.message.c_str());
  std::abort();
}
