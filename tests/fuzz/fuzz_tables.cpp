// Tables of scenarios, of models and of materials, made from the bytes. What is accepted is used:
// a value that passes the checks must not poison a run.

#include <array>
#include <utility>

#include "tests/fuzz/api_session.hpp"

namespace {

// Functions of the API, and those of ApiSession's Lua code that use their results.
constexpr std::array<std::pair<const char*, const char*>, 3> kTables{
    {{"scenario", "use_scenario"}, {"model", "use_model"}, {"grid", "use_grid"}}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static springlod::fuzz::ApiSession session;
  springlod::fuzz::Choices choices(data, size);
  const auto& [function, use] = kTables[choices.below(kTables.size())];
  session.call_and_use(*session.api().find_function(function), choices, use);
  return 0;
}
