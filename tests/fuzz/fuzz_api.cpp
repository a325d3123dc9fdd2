// Calls functions and methods of the scripting API with arguments made from the bytes, most of them
// of the documented types, with extreme values. Any result or error is right, but for an error that
// is none of the documented refusals. Run it in a folder of its own: functions may write files.

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "tests/fuzz/api_session.hpp"

namespace {

using springlod::fuzz::ApiSession;
using springlod::fuzz::Choices;
using springlod::scripting::Api;
using springlod::scripting::FunctionEntry;

// They draw, or call gnuplot and ffmpeg, which takes seconds; help prints.
constexpr std::array<std::string_view, 5> kSlow{"animate", "chart", "help", "render", "video"};

constexpr int kMostCalls = 4;  // of an input; later calls may depend on what earlier ones kept

std::vector<const FunctionEntry*> callable(const Api& api) {
  std::vector<const FunctionEntry*> entries;
  for (const FunctionEntry& function : api.functions())
    if (std::find(kSlow.begin(), kSlow.end(), function.name) == kSlow.end())
      entries.push_back(&function);
  for (const auto& type : api.types())
    for (const FunctionEntry& method : type.methods) entries.push_back(&method);
  return entries;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static ApiSession session;
  static const auto entries = callable(session.api());
  Choices choices(data, size);
  for (int calls = 0; calls < kMostCalls && !choices.at_end(); ++calls) {
    const FunctionEntry& entry = *entries[choices.below(entries.size())];
    if (entry.owner.empty())
      session.call(entry, choices);
    else
      session.call_method(entry, choices);
  }
  return 0;
}
