#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;
using springlod::test::obj_of_boxes;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

// A crate, a post and a crumb beside each other: 32, 12 and 4 cells of 50 cm.
const char* const kProps = "props.obj";
void write_props(const TemporaryFolder& scratch) {
  spit(scratch / kProps, obj_of_boxes({{"crumb", 0, 0.5}, {"crate", 1, 5}, {"post", 6, 7.5}}));
}

Ran convert(const TemporaryFolder& scratch, const std::string& asset,
            const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"convert", (scratch / kProps).string(),
                                     "-o",      (scratch / asset).string(),
                                     "--fast",  "--cell",
                                     "50cm",    "--levels",
                                     "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return springlod_run(arguments);
}

json info_of(const fs::path& asset) {
  return json::parse(springlod_run({"info", asset.string(), "--json"}).out);
}

double mass_of(const fs::path& asset) {
  return info_of(asset).at("levels").at(0).at("mass").get<double>();
}

}  // namespace

TEST_CASE("convert keeps all bodies together by default, and says how to take them apart") {
  const TemporaryFolder scratch;
  write_props(scratch);
  const Ran ran = convert(scratch, "all.glb", {});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("3 bodies that do not touch, of 4 to 32 cells") &&
                          Contains("--bodies largest or separate"));
  CHECK(mass_of(scratch / "all.glb") == Approx(6000));
  CHECK(info_of(scratch / "all.glb").at("surface_triangles") == 36);
}

TEST_CASE("convert --bodies largest keeps the largest body with its triangles") {
  const TemporaryFolder scratch;
  write_props(scratch);
  const Ran ran = convert(scratch, "crate.glb", {"--bodies", "largest"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("kept the largest of 3 bodies: 32 of 48 cells (66.7 %)"));
  CHECK(mass_of(scratch / "crate.glb") == Approx(4000));
  CHECK(info_of(scratch / "crate.glb").at("surface_triangles") == 12);
}

TEST_CASE("convert --bodies separate makes an asset of each body, in order of volume") {
  const TemporaryFolder scratch;
  write_props(scratch);
  const Ran ran = convert(scratch, "prop.glb", {"--bodies", "separate"});
  CAPTURE(ran.out, ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_FALSE(fs::exists(scratch / "prop.glb"));
  CHECK(mass_of(scratch / "prop-1.glb") == Approx(4000));
  CHECK(mass_of(scratch / "prop-2.glb") == Approx(1500));
  CHECK(mass_of(scratch / "prop-3.glb") == Approx(500));
  CHECK_FALSE(fs::exists(scratch / "prop-4.glb"));
  CHECK(info_of(scratch / "prop-2.glb").at("surface_triangles") == 12);
  CHECK(info_of(scratch / "prop-2.glb").at("provenance").at("body") == "2 of 3");
  CHECK_THAT(ran.out, Contains("volume") && Contains("prop-3.glb"));

  // The printed command makes the same files again.
  const std::string second = (scratch / "prop-2.glb").string();
  CHECK_THAT(springlod_run({"info", second}).out,
             Contains("--bodies separate -o " + (scratch / "prop.glb").string() + "\n"));
  const std::string bytes = slurp(second);
  REQUIRE(convert(scratch, "prop.glb", {"--bodies", "separate"}).exit_code == 0);
  CHECK(slurp(second) == bytes);
}

TEST_CASE("In a batch, each body has a row, and no mesh overwrites the body of another") {
  const TemporaryFolder scratch;
  write_props(scratch);
  spit(scratch / "props-2.obj", obj_of_boxes({{"box", 0, 1}}));
  const Ran ran =
      springlod_run({"convert", (scratch / kProps).string(), (scratch / "props-2.obj").string(),
                     "-o", (scratch / "out").string(), "--fast", "--cell", "50cm", "--levels", "1",
                     "--bodies", "separate", "-q"});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.out, Contains("out/props-1.glb") && Contains("out/props-3.glb") &&
                          Contains("would overwrite") && Contains("rename"));
  CHECK(mass_of(scratch / "out/props-2.glb") == Approx(1500));
}
