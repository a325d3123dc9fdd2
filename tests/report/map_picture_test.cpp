#include "report/map_picture.hpp"

#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "base/file.hpp"
#include "tests/report/programs.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;

namespace {

/// The lines of a text that contain `part`.
std::string lines_with(const std::string& text, const std::string& part) {
  std::string found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.find(part) != std::string::npos) found += line + "\n";
    begin = end + 1;
  }
  return found;
}

}  // namespace

TEST_CASE("the marks of a stability map are above the line of the limit") {
  sim::StabilityMap map;
  sim::StabilityBody& body = map.bodies.emplace_back();
  body.limit = 1e-3;
  for (const double step : {5e-4, 1e-3, 2e-3}) {
    sim::StabilityPoint& point = map.points.emplace_back();
    point.step = step;
    point.limit = body.limit;
    point.stable = point.finished = true;
    point.verdict = sim::Verdict::drifting;
    point.error = 0.2;
  }
  const TemporaryFolder folder;
  const PathIs nothing("");  // gnuplot is not found: the test reads the script
  draw_map(map, "", folder.path() / "map.svg");
  const std::string script = read_file(folder.path() / "map.gp");
  // gnuplot draws what is back, the plot, and what is front.
  const std::string lines = lines_with(script, "set arrow");
  CHECK(lines_with(lines, "E4002B").find(" back ") != std::string::npos);
  CHECK(lines.find(" front ") == std::string::npos);
  const std::string marks = lines_with(script, "'~'");
  CHECK(std::count(marks.begin(), marks.end(), '\n') == 3);
  CHECK(lines_with(marks, " front ") == marks);
}
