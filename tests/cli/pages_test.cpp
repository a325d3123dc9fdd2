// The examples in the pages and samples work as printed.

#include <algorithm>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;
namespace fs = std::filesystem;

namespace {

const fs::path kSource = source_folder();

// The ```lua blocks of a page in order, to be run as one script, without blocks that are separate
// files ("return {...}").
std::string script_of(const fs::path& page) {
  std::istringstream lines(slurp(page));
  std::string script;
  std::string block;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```lua") {
      inside = true;
      block.clear();
    } else if (inside && line == "```") {
      inside = false;
      if (!block.starts_with("return")) script += block;
    } else if (inside) {
      block += line + "\n";
    }
  }
  return script;
}

// The arguments of all calls of the program in the ```sh blocks of a page, continued lines joined.
std::vector<std::vector<std::string>> commands_of(const fs::path& page) {
  std::istringstream lines(slurp(page));
  std::vector<std::vector<std::string>> commands;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) inside = line == "```sh";
    for (std::string more; inside && line.ends_with("\\") && std::getline(lines, more);) {
      line.pop_back();
      line += more;
    }
    std::istringstream words(line);
    std::string program;
    words >> program;
    if (!inside || (program != "springlod" && !program.ends_with("/springlod"))) continue;
    commands.emplace_back();
    // What comes after -- is of a script.
    for (std::string word; words >> word && word[0] != '#' && word != "--";)
      commands.back().push_back(word);
  }
  return commands;
}

// A folder with samples/, like the root of the repository, for scripts that write to out/.
void lay_out(const TemporaryFolder& scratch) {
  fs::create_directory_symlink(kSource / "samples", scratch / "samples");
}

}  // namespace

TEST_CASE("the Lua of every page runs", "[long]") {
  std::vector<fs::path> pages{kSource / "README.md"};
  for (const auto& entry : fs::directory_iterator(kSource / "docs"))
    if (entry.path().extension() == ".md" && entry.path().filename() != "api.md")
      pages.push_back(entry.path());
  int scripts = 0;
  for (const fs::path& page : pages) {
    const std::string script = script_of(page);
    if (script.empty()) continue;
    ++scripts;
    const TemporaryFolder scratch;
    lay_out(scratch);
    spit(scratch / "page.lua", script);
    const Ran ran = springlod_run({"-q", "run", "page.lua"}, "", scratch.path());
    CAPTURE(page.filename().string(), ran.err);
    CHECK(ran.exit_code == 0);
  }
  CHECK(scripts >= 6);
}

TEST_CASE("every option that a page gives to a stock command is one of its options") {
  int options = 0;
  std::map<std::string, std::string> helps;  // by command
  for (const char* name : {"README.md", "docs/convert.md", "docs/simulate.md", "docs/pictures.md",
                           "docs/integrators.md", "docs/pareto.md", "docs/pick.md",
                           "docs/export.md", "docs/asset-format.md", "docs/sweeps.md"})
    for (const auto& command : commands_of(kSource / name)) {
      if (command.empty()) continue;
      std::string& help = helps[command[0]];
      if (help.empty()) help = springlod_run({command[0], "--help"}).out;
      for (const std::string& word : command) {
        if (!word.starts_with("--") || word == "--") continue;
        CAPTURE(name, command[0]);
        CHECK_THAT(help, Contains(word + " ") || Contains(word + "]"));
        ++options;
      }
    }
  CHECK(options >= 5);
}

TEST_CASE("the sample scripts run and write their documented files", "[long]") {
  const TemporaryFolder scratch;
  const auto wrote = [&](const std::string& sample, const std::vector<std::string>& files) {
    const std::string folder = (scratch / sample).string();
    const Ran ran = springlod_run({"-q", "run", "samples/" + sample + ".lua", "--", folder});
    CAPTURE(sample, ran.err);
    CHECK(ran.exit_code == 0);
    for (const std::string& file : files) CHECK(fs::file_size(fs::path(folder) / file) > 0);
  };
  wrote("dumbbell", {"dumbbell.glb", "levels.png", "frames/frame_0029.png"});
  wrote("ball", {"ball.glb", "ledger.csv", "levels.png"});
  wrote("stiffness", {"height.csv", "height.gp", "frames/frame_0029.png"});
  wrote("beast", {"beast.glb", "cost-error.svg", "frames/frame_0023.png"});
}

TEST_CASE("the demo reports correct node counts and writes table, chart, video and assets",
          "[long]") {
  const TemporaryFolder scratch;
  const fs::path folder = scratch / "demo";
  const Ran ran = springlod_run({"-q", "run", "scripts/demo.lua", "--", folder.string(), "1"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const std::string counts = slurp(folder / "counts.csv");
  CHECK_THAT(counts, Contains("base,368,4748,368,4724"));
  CHECK_THAT(counts, Contains("LOD-hb level 2,"));
  for (const char* file : {"table.csv", "timings.csv", "chart.svg", "chart.png", "lod-chain.glb",
                           "lod-b-chain.glb", "lod-h-chain.glb", "lod-hb-chain.glb",
                           "lod-fit-chain.glb", "frames/frame_0059.png", "index.html"})
    CHECK(fs::file_size(folder / file) > 0);
  CHECK_FALSE(fs::exists(folder / "frames/frame_0060.png"));  // 60 by default
  const std::string table = slurp(folder / "table.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 1 + 10);  // head, base, 5 x 2 levels
  CHECK_THAT(ran.out, Contains("Merged as in the paper, level 2 needs ") &&
                          Contains("Fitted to the base, with contact at its surface, level 2") &&
                          Contains("By the clock of this machine"));
}
