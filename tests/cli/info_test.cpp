#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "model/asset/asset.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using nlohmann::json;
using springlod::test::obj_of_boxes;
using springlod::test::obj_of_open_box;
using springlod::test::Ran;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("info of a mesh tells its parts, size, faults and cells") {
  const TemporaryFolder scratch;
  spit(scratch / "open.obj", obj_of_open_box());
  const std::string mesh = (scratch / "open.obj").string();
  const Ran text = springlod_run({"info", mesh});
  CAPTURE(text.out, text.err);
  REQUIRE(text.exit_code == 0);
  CHECK_THAT(text.out, Contains("OBJ, 8 vertices, 10 triangles, 1 m x 1 m x 1 m (1 unit = 1 m, "
                                "assumed)"));
  CHECK_THAT(text.out, Contains("tub") && Contains("1 hole") && Contains("--cell 31.2mm"));
  const Ran parsed = springlod_run({"info", mesh, "--json", "--unit", "mm"});
  REQUIRE(parsed.exit_code == 0);
  const json info = json::parse(parsed.out);
  CHECK(info.at("solids").at(0).at("holes") == 1);
  CHECK(info.at("solids").at(0).at("volume").get<double>() == Approx(1e-9));
  CHECK(info.at("unit_assumed") == false);
  CHECK_FALSE(info.contains("doubt"));
  CHECK(info.at("default_cells") == 32 * 32 * 32);
  CHECK(info.at("bodies") == 1);
  CHECK_FALSE(info.contains("refusal"));

  spit(scratch / "huge.obj", obj_of_boxes({{"bar", 0, 50}}));
  const Ran huge = springlod_run({"info", (scratch / "huge.obj").string()});
  CHECK_THAT(huge.out, Contains("unusual size") && Contains("--unit cm makes it 500 mm") &&
                           Contains("No faults."));
}

TEST_CASE("info of a mesh counts the bodies that convert would make") {
  const TemporaryFolder scratch;
  spit(scratch / "two.obj", obj_of_boxes({{"left", 0, 1}, {"right", 2, 3}}));
  const std::string mesh = (scratch / "two.obj").string();
  const Ran text = springlod_run({"info", mesh});
  CAPTURE(text.out, text.err);
  CHECK_THAT(text.out, Contains("2 bodies that do not touch"));
  CHECK(json::parse(springlod_run({"info", mesh, "--json"}).out).at("bodies") == 2);
}

TEST_CASE("info of a mesh says that convert would refuse it") {
  const TemporaryFolder scratch;
  spit(scratch / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const std::string mesh = (scratch / "sheet.obj").string();
  const Ran text = springlod_run({"info", mesh});
  CAPTURE(text.out, text.err);
  CHECK(text.exit_code == 0);
  CHECK_THAT(text.out, Contains("convert would refuse it: ") && Contains("encloses") &&
                           !Contains("would repair"));
}

TEST_CASE("info prints the certificates of levels") {
  const TemporaryFolder scratch;
  const std::string path = (scratch / "asset.glb").string();
  springlod::LodAsset asset = springlod::test::sample_asset();
  asset.chain.levels[1].certificate = springlod::test::sample_certificate();
  springlod::Certificate good = springlod::test::sample_certificate();
  good.unmet.clear();
  good.loads.clear();
  asset.chain.levels[2].certificate = good;
  springlod::save_asset(asset, path);

  const Ran info = springlod_run({"info", path, "--json"});
  CAPTURE(info.err);
  REQUIRE(info.exit_code == 0);
  const json levels = json::parse(info.out).at("levels");
  CHECK_FALSE(levels.at(0).contains("certificate"));
  const json& c = levels.at(1).at("certificate");
  CHECK(c.at("moduli").at(1) == json{{"material", "rubber"},
                                     {"young", 1e5 / 7},
                                     {"base_young", 1e5},
                                     {"poisson", 0.1},
                                     {"base_poisson", 0.2}});
  CHECK(c.at("frequencies").at(0).at("level") == 10.0 / 3);
  CHECK(c.at("frequencies").at(0).at("error").get<double>() == Approx(10.0 / 3 / 3.3 - 1));
  CHECK(c.at("frequencies").at(1).at("mac") == 0.2);
  CHECK(c.at("loads").at(1) == json{{"name", "pinch \"1\""}, {"held_out", true}, {"error", 0.1}});
  CHECK(c.at("fitted_load_error").get<double>() == Approx(0.02 / 3));
  CHECK(c.at("held_out_load_error") == 0.1);
  CHECK(c.at("f1_10_error").get<double>() > 0);
  CHECK_FALSE(c.contains("f11_20_error"));  // only two frequencies
  CHECK(c.at("cost_ratio").get<double>() == Approx(1.0 / 110));
  CHECK(c.at("zero_modes") == 7);
  CHECK(c.at("expected_zero_modes") == 6);
  CHECK(c.at("tolerance") == 0.05);
  CHECK(c.at("misses").size() == 2);
  CHECK(c.at("grade") == "faulty");
  CHECK_THAT(
      c.at("summary").get<std::string>(),
      Contains("7 zero modes instead of 6") && Contains("rubber has 0.14 of its Young's modulus"));
  CHECK(c.at("decay_error").get<double>() == Approx(((1 - 1 / 7.0 / 0.15) + 0.5) / 2));
  for (const char* key : {"mass_error", "center_shift", "second_moment_error", "highest_frequency",
                          "stable_step", "cost", "mac", "blow_error", "first_period_error",
                          "contact_ratio", "kernel", "seconds", "seconds_ratio"})
    CHECK(c.contains(key));
  CHECK_FALSE(levels.at(2).at("certificate").contains("fitted_load_error"));

  const Ran text = springlod_run({"info", path});
  CAPTURE(text.out, text.err);
  REQUIRE(text.exit_code == 0);
  CHECK_THAT(text.out, Contains("first period") && Contains("0.33 %") && Contains("10 %"));
  CHECK_THAT(text.out,
             Contains("level 1 is faulty: 7 zero modes instead of 6; natural frequencies"));
  CHECK_THAT(text.out, Contains("rubber E 14.3 kPa (0.14 of the base), nu 0.10 (0.20)"));
  CHECK_THAT(text.out, Contains("level 1 is outside tolerance: f1..10"));
  CHECK_THAT(text.out, !Contains("level 2 is outside"));
}

TEST_CASE("info refuses files that are neither assets nor meshes") {
  const TemporaryFolder scratch;
  spit(scratch / "x.glb", "not an asset");
  for (const char* name : {"x.glb", "none.glb"}) {
    const Ran ran = springlod_run({"info", (scratch / name).string()});
    CHECK(ran.exit_code == 1);
    CHECK(ran.out.empty());
    CHECK_THAT(ran.err, Contains(name));
  }
}
