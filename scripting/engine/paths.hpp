#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace springlod::scripting {

/// The folder of the stock scripts: ../share/springlod/scripts beside the running program if it is
/// installed, else scripts/ of the source tree it was built from. Throws IoError if neither exists.
std::filesystem::path stock_script_folder();

/// The folder of the sample meshes and scenes, beside that of the stock scripts.
std::filesystem::path sample_folder();

/// The folder of the documentation, beside that of the stock scripts. It may be missing.
std::filesystem::path doc_folder();

/// A stock command: scripts/NAME.lua, or scripts/studies/NAME.lua for the studies that evaluate the
/// methods. The comment in its first line is its summary.
struct StockCommand {
  std::string name;
  std::string summary;
  std::filesystem::path script;
  bool study = false;
};
/// Commands sorted by name, then studies sorted by name.
std::vector<StockCommand> stock_commands();

/// $XDG_STATE_HOME/springlod/history, or ~/.local/state/springlod/history; empty if HOME is not
/// set.
std::filesystem::path history_file();

}  // namespace springlod::scripting
