#include "scripting/bind/sweep/sweep_program.hpp"

#include <algorithm>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/session.hpp"

namespace springlod::scripting {

namespace fs = std::filesystem;

fs::path this_program() {
  return fs::read_symlink("/proc/self/exe");
}

std::string program_hash() {
  std::vector<fs::path> scripts;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(stock_script_folder()))
    if (entry.path().extension() == ".lua") scripts.push_back(entry.path());
  std::sort(scripts.begin(), scripts.end());
  std::string hashes = content_hash(read_file(this_program()));
  for (const fs::path& script : scripts)
    hashes +=
        script.lexically_relative(stock_script_folder()).string() + content_hash(read_file(script));
  return content_hash(hashes);
}

sweep::Plan checked_plan(const Session& session, const fs::path& folder) {
  sweep::Plan plan = sweep::read_plan(folder);
  sweep::require_unchanged(plan, version(), program_hash());
  if (session.settings().portable && !plan.portable)
    throw InputError(
        "the plan was made without --portable, and its units run without it: make a new plan with "
        "--portable in another folder");
  return plan;
}

Parameter sweep_argument() {
  return {.name = "sweep", .type = "Sweep", .help = "what the script returns"};
}

Parameter sweep_folder_argument() {
  return {.name = "folder", .type = "string", .help = "folder of the plan"};
}

}  // namespace springlod::scripting
