// springlod pick and s.pick.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::Row;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

const char* const kScenario =
    "return {name = 'drop', duration = 0.4, throw = {velocity = {1, 0, 0}, spin = {0, 1, 0}},\n"
    "        obstacles = {{plane = {0, 0, 1, -0.1}, name = 'floor', friction = 0.4}}}\n";

void make_asset(const TemporaryFolder& scratch) {
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.25", "--lattice", "corners"});
  spit(scratch / "drop.lua", kScenario);
}

Ran pick(const TemporaryFolder& scratch, const std::vector<std::string>& more) {
  std::vector<std::string> all{"pick", (scratch / "bar.glb").string(), "--scenario",
                               (scratch / "drop.lua").string()};
  all.insert(all.end(), more.begin(), more.end());
  return springlod_run(all);
}

nlohmann::json picked(const TemporaryFolder& scratch, std::vector<std::string> more) {
  more.emplace_back("--json");
  const Ran ran = pick(scratch, more);
  CAPTURE(ran.err, ran.out);
  REQUIRE(ran.exit_code == 0);
  return nlohmann::json::parse(ran.out);
}

}  // namespace

TEST_CASE("pick prints a table and a sentence, and certifies levels that need it") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran ran = pick(scratch, {"--error", "20%"});
  CAPTURE(ran.err, ran.out);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("certifying levels 1, 2"));
  CHECK_THAT(ran.out, Contains("predicted error [%]") && Contains("yes *") &&
                          Contains("stays within 20 %") && Contains("a frame"));
}

TEST_CASE("pick takes the coarsest level within the error, the same for any number of threads") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto loose = picked(scratch, {"--error", "50%"});
  CHECK(loose["level"] == 2);
  CHECK(loose["measured"] == false);
  REQUIRE(loose["levels"].size() == 3);
  CHECK(loose["levels"][0]["error"] == 0);
  const auto strict = picked(scratch, {"--error", "0.0001%"});
  CHECK(strict["level"] == 0);
  CHECK(strict["levels"][1]["within"] == false);
  const auto one = picked(scratch, {"--error", "50%", "--threads", "1"});
  for (int level = 0; level < 3; ++level)
    CHECK(one["levels"][level]["error"] == loose["levels"][level]["error"]);
}

TEST_CASE("pick --measure has the errors of compare") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto measured = picked(scratch, {"--error", "50%", "--measure", "--frame-rate", "30"});
  CHECK(measured["measured"] == true);
  const Ran compared =
      springlod_run({"-q", "compare", (scratch / "bar.glb").string(), "--scenario",
                     (scratch / "drop.lua").string(), "--out", (scratch / "out").string(),
                     "--frames", "0", "--starts", "1"});
  REQUIRE(compared.exit_code == 0);
  const std::vector<Row> rows = rows_of(slurp(scratch / "out/table.csv"));
  REQUIRE(rows.size() == 3);
  for (std::size_t level = 0; level < 3; ++level)
    CHECK(100 * measured["levels"][level]["error"].get<double>() ==
          Approx(springlod::test::number(rows[level], "surface_error_percent")));
}

TEST_CASE("pick --budget takes the most accurate level, or fails with the cheapest") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto rich = picked(scratch, {"--budget", "1s"});
  CHECK(rich["level"] == 0);
  const Ran poor = pick(scratch, {"--budget", "1e-9s"});
  CHECK(poor.exit_code == 1);
  CHECK_THAT(poor.out, Contains("No level stays within") && Contains("The cheapest is level"));
  const Ran json = pick(scratch, {"--budget", "1e-9s", "--json"});
  CHECK(json.exit_code == 1);
  CHECK_FALSE(nlohmann::json::parse(json.out).contains("level"));
}

TEST_CASE("pick reports wrong requests and files in one line") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto refused = [&](const std::vector<std::string>& more, int code,
                           const std::string& reason) {
    const Ran ran = pick(scratch, more);
    CAPTURE(ran.err, reason);
    CHECK(ran.exit_code == code);
    CHECK_THAT(ran.err, Contains(reason) && !Contains("traceback"));
  };
  refused({}, 2, "give --error (such as --error 2%) or --budget");
  refused({"--error", "2%", "--budget", "2ms"}, 2, "--budget");
  refused({"--error", "2q"}, 2, "unknown unit \"q\"");
  refused({"--error", "2"}, 2, "write 2%");
  refused({"--error", "0%"}, 2, "must be above 0%");
  refused({"--budget", "2kg"}, 2, "--budget");
  refused({"--budget", "0ms"}, 2, "must be above 0");
  refused({"--error", "2%", "--contact", "skin"}, 2, "surface");
  spit(scratch / "drop.lua", "return {duratoin = 1}");
  refused({"--error", "2%"}, 1, "did you mean 'duration'?");
  std::filesystem::remove(scratch / "drop.lua");
  refused({"--error", "2%"}, 1, "cannot pick a level");
  spit(scratch / "drop.lua", kScenario);
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.5", "--levels", "0"});
  refused({"--error", "2%"}, 1, "only its base");
}

TEST_CASE("a script picks a level, runs it and reads why") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  spit(scratch / "script.lua", R"(
    local s = require "springlod"
    local chain = s.load(arg[1])
    local scene = dofile(arg[2])
    local pick = s.pick(chain, scene, {error = "50 %"})
    print(pick.level, pick.model.node_count == chain[2].node_count, pick.measured)
    print(pick.text == tostring(pick), #pick:table(), pick.chain.coarsest)
    print(s.info(pick.chain).levels[2].certificate ~= nil)
    local none = s.pick(pick.chain, scene, {budget = 1e-9})
    print(none.level, none.model)
    print(pcall(s.pick, chain, scene, {error = 2}))
    print(pcall(s.pick, chain, scene)))");
  const Ran ran = springlod_run({"-q", "run", (scratch / "script.lua").string(), "--",
                                 (scratch / "bar.glb").string(), (scratch / "drop.lua").string()});
  CAPTURE(ran.err, ran.out);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("2\ttrue\tfalse\ntrue\t3\t2\ntrue\nnil\tnil\nfalse\t"));
  CHECK_THAT(ran.out, Contains("write \"2 %\"") && Contains("give error (such as"));
}

TEST_CASE("pick warns of a start inside an obstacle as compare does") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  std::string deep = kScenario;
  deep.replace(deep.find("-0.1"), 4, "0.5");
  spit(scratch / "drop.lua", deep);
  const auto warning = [](const std::string& text) {
    const auto at = text.find("the body starts ");
    REQUIRE(at != std::string::npos);
    return text.substr(at, text.find('\n', at) - at);
  };
  const std::string picked = warning(pick(scratch, {"--error", "20%"}).err);
  CHECK_THAT(picked, Contains("deep inside the obstacle floor, which will throw it out"));
  const Ran compared = springlod_run({"compare", (scratch / "bar.glb").string(), "--scenario",
                                      (scratch / "drop.lua").string(), "--starts", "1", "--frames",
                                      "0", "-o", (scratch / "out").string()});
  CHECK(warning(compared.err) == picked);
}
