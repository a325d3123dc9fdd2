// springlod figures.

#include <set>
#include <sstream>

#include <catch2/catch.hpp>

#include "render/frames.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;
namespace fs = std::filesystem;

namespace {

std::size_t colour_count(const springlod::render::Image& image) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t p = 0; p < image.rgb.size(); p += 3)
    colours.insert({image.rgb[p], image.rgb[p + 1], image.rgb[p + 2]});
  return colours.size();
}

}  // namespace

TEST_CASE("all figures of the paper are drawn, and none is blank") {
  const TemporaryFolder scratch;
  const Ran ran = springlod_run({"-q", "figures", "--quick", scratch.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  std::set<std::string> pictures;
  std::istringstream lines(ran.out);
  for (std::string line; std::getline(lines, line);) {
    const fs::path path = line.substr(0, line.find(": "));
    CAPTURE(path.string());
    REQUIRE(fs::exists(path));
    pictures.insert(path.filename().string());
    if (path.extension() != ".png") continue;
    const auto image = springlod::render::load_png(path);
    CHECK(image.width > 400);
    CHECK(image.height > 200);
    CHECK(colour_count(image) > 500);
  }
  for (const char* name :
       {"figure-1.png", "figure-2.png", "figure-2.svg", "figure-3.png", "figure-4.png",
        "figure-5.png", "figure-6.png", "figure-7.png", "figure-8.png", "figure-e-density-ball.png",
        "figure-e-density-rods.png"}) {
    CAPTURE(name);
    CHECK(pictures.count(name) == 1);
  }
}

TEST_CASE("the masses of figure 2 equal those of the paper") {
  const Ran ran = springlod_run({"-q", "-e", R"(
    local s = require "springlod"
    local figures = require "studies.paper.figures"
    for _, rule in ipairs {"proportional", "proximity"} do
      local chain = figures.row_of_nodes(rule)
      for level = 1, 2 do
        local masses = {}
        for i, node in ipairs(chain[level]:nodes()) do masses[i] = node.mass end
        print(rule, level, table.concat(masses, " "))
      end
    end)"});
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("proportional\t1\t1.0 1.0 1.0 1.0 1.0 1.0"));
  CHECK_THAT(ran.out, Contains("proportional\t2\t1.0 1.0 2.0 1.0 1.0"));
  CHECK_THAT(ran.out, Contains("proximity\t2\t1.0 1.25 1.5 1.25 1.0"));
}
