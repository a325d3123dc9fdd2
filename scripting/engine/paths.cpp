#include "scripting/engine/paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::scripting {

namespace fs = std::filesystem;

namespace {

// Sorted by name.
std::vector<StockCommand> commands_in(const fs::path& folder, bool study) {
  std::vector<StockCommand> commands;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".lua") continue;
    std::ifstream in(entry.path());
    std::string line;
    std::getline(in, line);
    const std::size_t text = line.find_first_not_of("- ");
    commands.push_back({entry.path().stem().string(),
                        text == std::string::npos ? "" : line.substr(text), entry.path(), study});
  }
  std::sort(commands.begin(), commands.end(),
            [](const StockCommand& a, const StockCommand& b) { return a.name < b.name; });
  return commands;
}

}  // namespace

fs::path stock_script_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  fs::path installed = program.parent_path().parent_path() / "share/springlod/scripts";
  if (!error && fs::is_directory(installed, error)) return installed;
  fs::path source = SPRINGLOD_SCRIPT_FOLDER;
  if (fs::is_directory(source, error)) return source;
  throw IoError(
      fmt::format("the stock scripts are neither in {} nor in {}; install springlod again",
                  installed.string(), source.string()));
}

fs::path sample_folder() {
  return stock_script_folder().parent_path() / "samples";
}

fs::path doc_folder() {
  return stock_script_folder().parent_path() / "docs";
}

std::vector<StockCommand> stock_commands() {
  std::vector<StockCommand> commands = commands_in(stock_script_folder(), false);
  const std::vector<StockCommand> studies = commands_in(stock_script_folder() / "studies", true);
  commands.insert(commands.end(), studies.begin(), studies.end());
  return commands;
}

fs::path history_file() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return fs::path(state) / "springlod/history";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != 0) return fs::path(home) / ".local/state/springlod/history";
  return {};
}

}  // namespace springlod::scripting
