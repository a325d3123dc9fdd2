#include <filesystem>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

json info_of(const fs::path& asset) {
  const Ran ran = springlod_run({"info", asset.string(), "--json"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  return json::parse(ran.out);
}

}  // namespace

TEST_CASE("slim writes a smaller asset that info and compare take") {
  const TemporaryFolder scratch;
  const fs::path whole = scratch / "bar.glb";
  const fs::path slim = scratch / "bar-slim.glb";
  make_bar_asset(whole, 6, {"--cell", "0.25", "--levels", "2"});
  const Ran ran = springlod_run({"slim", whole.string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("single precision") && Contains("stable step") &&
                          Contains(" kB instead of "));
  CHECK_THAT(ran.err, Contains("wrote " + slim.string()));
  CHECK(fs::file_size(slim) < 0.4 * static_cast<double>(fs::file_size(whole)));

  const json before = info_of(whole);
  const json after = info_of(slim);
  REQUIRE(after.at("levels").size() == 3);
  for (std::size_t level = 0; level < 3; ++level) {
    const json& p = before.at("levels").at(level);
    const json& q = after.at("levels").at(level);
    for (const char* key : {"nodes", "springs", "corners", "border_nodes", "made_by"})
      CHECK(p.at(key) == q.at(key));
    for (const char* key : {"mass", "stable_dt"})
      CHECK(q.at(key).get<double>() == Approx(p.at(key).get<double>()).epsilon(1e-6));
  }
  CHECK_THAT(after.at("provenance").at("slim").get<std::string>(), Contains("single precision"));
  CHECK_FALSE(before.at("provenance").contains("slim"));

  // The commands that make it again.
  CHECK_THAT(springlod_run({"info", slim.string()}).out,
             Contains(" -o " + whole.string() + " && springlod slim " + whole.string() + " -o " +
                      slim.string() + "\n"));

  // A run differs by what single precision changes.
  const Ran moved = springlod_run({"--unsafe", "-e",
                                   R"lua(
    local s = require "springlod"
    local paths = {")lua" + whole.string() +
                                       R"lua(", ")lua" + slim.string() + R"lua("}
    for _, path in ipairs(paths) do
      local runs = s.compare(s.load(path), {duration = 0.2, gravity = {0, 0, -9.81},
        throw = {position = {0, 0, 0.6}}, obstacles = {{plane = {0, 0, 1, 0}}}})
      local rows = runs:table()
      print(("%.9g"):format(rows[3].surface_error_percent))
    end
  )lua"});
  CAPTURE(moved.err);
  REQUIRE(moved.exit_code == 0);
  const double error = std::stod(moved.out);
  const double slim_error = std::stod(moved.out.substr(moved.out.find('\n')));
  CHECK(error > 0);
  CHECK(slim_error == Approx(error).epsilon(1e-3));
}

TEST_CASE("slim refuses wrong use and keeps the asset") {
  const TemporaryFolder scratch;
  const fs::path whole = scratch / "bar.glb";
  make_bar_asset(whole, 3, {"--cell", "1", "--levels", "1"});
  const std::string before = slurp(whole);
  const auto refuses = [&](const std::vector<std::string>& arguments, int code,
                           const std::string& reason) {
    std::vector<std::string> words{"slim"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Ran ran = springlod_run(words);
    CAPTURE(arguments, ran.err);
    CHECK(ran.exit_code == code);
    CHECK_THAT(ran.err, Contains(reason));
  };
  refuses({}, 2, "missing argument 'asset'");
  refuses({whole.string(), "-o", (scratch / "bar.obj").string()}, 2, "must end in .glb");
  refuses({whole.string(), "-o", whole.string()}, 1, "overwrite itself");
  fs::create_symlink(whole, scratch / "link.glb");
  refuses({whole.string(), "-o", (scratch / "link.glb").string()}, 1, "overwrite itself");
  refuses({(scratch / "none.glb").string()}, 1, "No such file");
  refuses({(scratch / "bar.obj").string()}, 1, "not a .glb file");
  CHECK(slurp(whole) == before);
  CHECK_FALSE(fs::exists(scratch / "bar-slim.glb"));

  // A file of that name is replaced, as by convert.
  spit(scratch / "bar-slim.glb", "something else");
  CHECK(springlod_run({"slim", whole.string()}).exit_code == 0);
  const std::string slim = slurp(scratch / "bar-slim.glb");
  CHECK(slim.starts_with("glTF"));
  // The same asset gives the same bytes.
  CHECK(springlod_run({"slim", whole.string()}).exit_code == 0);
  CHECK(slurp(scratch / "bar-slim.glb") == slim);
}

TEST_CASE("slim writes assets of older versions of the format again, slim ones too") {
  const TemporaryFolder scratch;
  for (const char* version : {"1", "2", "3", "4", "5"}) {
    CAPTURE(version);
    const fs::path old =
        springlod::test::source_folder() / "tests/golden" / fmt::format("version_{}.glb", version);
    const fs::path slim = scratch / "slim.glb";
    const Ran ran = springlod_run({"slim", old.string(), "-o", slim.string()});
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    CHECK_THAT(slurp(slim), Contains(R"("version":6)") && Contains(R"("checksum":"crc32:)"));
    const json before = info_of(old);
    const json after = info_of(slim);
    REQUIRE(before.at("levels").size() == after.at("levels").size());
    for (std::size_t level = 0; level < before.at("levels").size(); ++level) {
      const json& p = before.at("levels").at(level);
      const json& q = after.at("levels").at(level);
      for (const char* key : {"nodes", "springs", "corners", "made_by"})
        CHECK(p.at(key) == q.at(key));
      CHECK(q.at("mass").get<double>() == Approx(p.at("mass").get<double>()).epsilon(1e-6));
    }
  }
}
