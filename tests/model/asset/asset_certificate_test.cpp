#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "tests/model/asset/glb_text.hpp"
#include "tests/support/assets.hpp"
#include "tests/support/temporary_folder.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::sample_asset;
using test::sample_certificate;
using test::TemporaryFolder;
using test::with_json;

/// An asset of three levels; level 1 has a certificate.
LodAsset certified_asset() {
  LodAsset asset = sample_asset();
  asset.chain.levels[1].certificate = sample_certificate();
  return asset;
}

void check_same(const Certificate& a, const Certificate& b) {
  REQUIRE(a.moduli.size() == b.moduli.size());
  for (std::size_t i = 0; i < a.moduli.size(); ++i) {
    CHECK(a.moduli[i].material == b.moduli[i].material);
    CHECK(a.moduli[i].young == b.moduli[i].young);
    CHECK(a.moduli[i].base_young == b.moduli[i].base_young);
    CHECK(a.moduli[i].poisson == b.moduli[i].poisson);
    CHECK(a.moduli[i].base_poisson == b.moduli[i].base_poisson);
  }
  REQUIRE(a.frequencies.size() == b.frequencies.size());
  for (std::size_t i = 0; i < a.frequencies.size(); ++i) {
    CHECK(a.frequencies[i].level == b.frequencies[i].level);
    CHECK(a.frequencies[i].base == b.frequencies[i].base);
    CHECK(a.frequencies[i].mac == b.frequencies[i].mac);
    CHECK(a.frequencies[i].decay == b.frequencies[i].decay);
    CHECK(a.frequencies[i].base_decay == b.frequencies[i].base_decay);
  }
  REQUIRE(a.loads.size() == b.loads.size());
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    CHECK(a.loads[i].name == b.loads[i].name);
    CHECK(a.loads[i].held_out == b.loads[i].held_out);
    CHECK(a.loads[i].compliance == b.loads[i].compliance);
    CHECK(a.loads[i].error == b.loads[i].error);
  }
  CHECK(a.mass_error == b.mass_error);
  CHECK(a.center_shift == b.center_shift);
  CHECK(a.second_moment_error == b.second_moment_error);
  CHECK(a.highest_frequency == b.highest_frequency);
  CHECK(a.base_highest_frequency == b.base_highest_frequency);
  CHECK(a.stable_step == b.stable_step);
  CHECK(a.base_stable_step == b.base_stable_step);
  CHECK(a.cost == b.cost);
  CHECK(a.base_cost == b.base_cost);
  CHECK(a.zero_modes == b.zero_modes);
  CHECK(a.expected_zero_modes == b.expected_zero_modes);
  CHECK(a.blow_error == b.blow_error);
  CHECK(a.first_period_error == b.first_period_error);
  CHECK(a.contact_ratio == b.contact_ratio);
  CHECK(a.tolerance == b.tolerance);
  CHECK(a.unmet == b.unmet);
}

TEST_CASE("Certificates are restored exactly, and other levels have none") {
  const TemporaryFolder folder;
  save_asset(certified_asset(), folder / "asset.glb");
  const LodAsset read = load_asset(folder / "asset.glb");
  REQUIRE(read.chain.levels[1].certificate);
  check_same(*read.chain.levels[1].certificate, sample_certificate());
  CHECK_FALSE(read.chain.levels[0].certificate);
  CHECK_FALSE(read.chain.levels[2].certificate);
  save_asset(read, folder / "again.glb");
  CHECK(read_file(folder / "asset.glb") == read_file(folder / "again.glb"));
}

TEST_CASE("A certificate with empty lists is restored") {
  const TemporaryFolder folder;
  LodAsset asset = sample_asset();
  Certificate bare;
  bare.tolerance = 0.05;
  asset.chain.levels[2].certificate = bare;
  save_asset(asset, folder / "asset.glb");
  const LodAsset read = load_asset(folder / "asset.glb");
  REQUIRE(read.chain.levels[2].certificate);
  check_same(*read.chain.levels[2].certificate, bare);
}

TEST_CASE("A certificate without the errors of motion is read: earlier versions had none") {
  const TemporaryFolder folder;
  LodAsset asset = certified_asset();
  Certificate& certificate = *asset.chain.levels[1].certificate;
  certificate.blow_error = certificate.first_period_error = certificate.contact_ratio = {};
  save_asset(asset, folder / "asset.glb");
  CHECK(read_file(folder / "asset.glb").find("firstPeriodError") == std::string::npos);
  check_same(*load_asset(folder / "asset.glb").chain.levels[1].certificate, certificate);
}

TEST_CASE("An asset without certificates has no certificate entry in its JSON") {
  const TemporaryFolder folder;
  save_asset(sample_asset(), folder / "asset.glb");
  CHECK(read_file(folder / "asset.glb").find("certificate") == std::string::npos);
}

TEST_CASE("A certificate with values that are not finite or negative is not saved") {
  const TemporaryFolder folder;
  LodAsset asset = certified_asset();
  Certificate& certificate = *asset.chain.levels[1].certificate;
  const auto refused = [&](const std::string& what) {
    CHECK_THROWS_WITH(save_asset(asset, folder / "asset.glb"),
                      Contains("level 1") && Contains(what));
    CHECK_FALSE(std::filesystem::exists(folder / "asset.glb"));
  };
  SECTION("an infinite time step") {
    certificate.stable_step = std::numeric_limits<double>::infinity();
    refused("a stable time step is inf");
  }
  SECTION("a negative cost") {
    certificate.cost = -1;
    refused("a cost is -1");
  }
  SECTION("a modulus") {
    certificate.moduli[1].poisson = NAN;
    refused("material rubber");
  }
  SECTION("a base frequency of zero") {
    certificate.frequencies[1].base = 0;
    refused("frequency 2");
  }
  SECTION("a load") {
    certificate.loads[0].error = NAN;
    refused("load stretch x");
  }
}

TEST_CASE("A malformed certificate is rejected with the name of the field") {
  const TemporaryFolder folder;
  save_asset(certified_asset(), folder / "asset.glb");
  const std::string bytes = read_file(folder / "asset.glb");
  const auto refused = [&](const std::string& from, const std::string& to,
                           const std::string& reason) {
    INFO(from << " -> " << to);
    std::ofstream(folder / "bad.glb", std::ios::binary) << with_json(bytes, from, to);
    CHECK_THROWS_AS(load_asset(folder / "bad.glb"), IoError);
    CHECK_THROWS_WITH(load_asset(folder / "bad.glb"),
                      Contains("bad.glb is damaged") && Contains(reason));
  };
  const std::string of = "the certificate of level 1";
  refused("\"massError\"", "\"massErorr\"", of + ": 'massError' is missing");
  refused("\"zeroModes\":7", "\"zeroModes\":7.5", "'zeroModes' must be a count, not number");
  refused("\"zeroModes\":7", "\"zeroModes\":-7", "'zeroModes' must be a count");
  refused("\"zeroModes\":7", "\"zeroModes\":4294967296", "'zeroModes' cannot be 4294967296");
  refused("\"tolerance\":", "\"tolerance\":true,\"t\":", "'tolerance' must be a number, not bool");
  refused("\"tolerance\":", "\"tolerance\":1e999,\"t\":", "1e999");
  refused("\"heldOut\":true", "\"heldOut\":1",
          of + ", loads 2: 'heldOut' must be true or false, not number");
  refused("\"material\":\"rubber\"", "\"material\":null",
          of + ", moduli 2: 'material' must be text, not null");
  refused("\"mac\"", "\"cam\"", of + ", frequencies 1: 'mac' is missing");
  refused("\"frequencies\":[", "\"frequencies\":[3,", "frequencies 1 must be an object, not num");
  refused("\"loads\":[", "\"loads\":{},\"l\":[", "'loads' must be a list, not object");
  refused("\"misses\":[", "\"misses\":[1,", of + ", misses 1 must be text, not number");
  refused("\"certificate\":{", "\"certificate\":[],\"c\":{", of + " must be an object, not array");
  refused("\"certificate\":{", "\"certificate\":null,\"c\":{", of + " must be an object, not null");
  // Changes that break no rule are detected by the checksum.
  refused("\"heldOut\":true", "\"heldOut\":false", "checksum");
}

TEST_CASE("Mean errors of a certificate") {
  const Certificate certificate = sample_certificate();
  CHECK(mean_frequency_error(certificate, 0, 10) ==
        Approx((std::abs(10.0 / 3 / 3.3 - 1) + std::abs(0.1 / 0.3 / 0.35 - 1)) / 2));
  CHECK(mean_frequency_error(certificate, 1, 2) == Approx(std::abs(0.1 / 0.3 / 0.35 - 1)));
  CHECK(mean_frequency_error(certificate, 10, 20) == 0);
  CHECK(mean_load_error(certificate, false) == Approx(0.02 / 3));
  CHECK(mean_load_error(certificate, true) == Approx(0.1));
}

}  // namespace
}  // namespace springlod
