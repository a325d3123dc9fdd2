#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "base/file.hpp"
#include "model/asset/asset.hpp"
#include "sim/fast/vector_target.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

/// Results that are equal on all processors, and on those with fused multiply-add.
const char* const kAny = "any";
const char* const kFusing = "fusing";

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// The numbers of all levels, without provenance and independent of the file layout.
std::string hash_of_levels(const fs::path& asset) {
  std::string bytes;
  for (const springlod::Level& level : springlod::load_asset(asset).chain.levels) {
    const springlod::MassSpringModel& model = level.model;
    append(bytes, model.rest);
    append(bytes, model.mass);
    append(bytes, model.volume);
    append(bytes, model.contact_area);
    append(bytes, model.border);
    append(bytes, model.material);
    append(bytes, model.a);
    append(bytes, model.b);
    append(bytes, model.rest_length);
    append(bytes, model.stiffness);
    append(bytes, model.damping);
    append(bytes, level.of_base.of);
  }
  return springlod::content_hash(bytes);
}

/// (processor kind, result) -> hash
using Hashes = std::map<std::pair<std::string, std::string>, std::string>;

Hashes read_hashes(const fs::path& file) {
  Hashes hashes;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind, result, hash;
    if (line.rfind('#', 0) != 0 && words >> kind >> result >> hash) hashes[{kind, result}] = hash;
  }
  return hashes;
}

void write_hashes(const fs::path& file, const Hashes& hashes) {
  std::ofstream out(file);
  out << "# Hashes of what tests/golden/main_job.lua computes: processor kind, result, xxh3-64.\n"
         "# SPRINGLOD_BLESS=1 writes those of this processor; CHANGELOG.md says why they "
         "changed.\n";
  for (const auto& [key, hash] : hashes)
    out << key.first << ' ' << key.second << ' ' << hash << '\n';
}

}  // namespace

TEST_CASE("The main job has the results whose hashes are kept") {
  const TemporaryFolder scratch;
  const std::string script =
      (springlod::test::source_folder() / "tests/golden/main_job.lua").string();
  const Ran ran = springlod_run({"-q", "--portable", "run", script, "--", scratch.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);

  // Without --portable too, merging has these results, and steps have the same on all processors
  // that round the sum of a product once.
  const TemporaryFolder usual;
  const Ran plain = springlod_run({"-q", "run", script, "--", usual.path().string()});
  CAPTURE(plain.err);
  REQUIRE(plain.exit_code == 0);
  CHECK(hash_of_levels(usual / "merged.glb") == hash_of_levels(scratch / "merged.glb"));

  const char* const kind = springlod::sim::fuses_products() ? kFusing : kAny;
  const Hashes found{
      {{kind, "merged-comparison"}, springlod::content_hash(slurp(usual / "merged.csv"))},
      {{kAny, "merged-levels"}, hash_of_levels(scratch / "merged.glb")},
      {{kAny, "merged-comparison"}, springlod::content_hash(slurp(scratch / "merged.csv"))},
      {{kAny, "calibrated-levels"}, hash_of_levels(scratch / "calibrated.glb")},
      {{kAny, "calibrated-comparison"},
       springlod::content_hash(slurp(scratch / "calibrated.csv"))}};

  const fs::path kept = springlod::test::source_folder() / "tests" / "golden" / "results.txt";
  Hashes wanted = read_hashes(kept);
  const char* bless = std::getenv("SPRINGLOD_BLESS");
  if (bless != nullptr && std::string(bless) == "1") {
    for (const auto& [key, hash] : found) wanted[key] = hash;
    write_hashes(kept, wanted);
    WARN("blessed " << kept.string());
    return;
  }
  for (const auto& [key, hash] : found) {
    const auto known = wanted.find(key);
    if (known == wanted.end()) {
      WARN("no hash of " << key.second << " is kept for processors of kind " << key.first
                         << ": it is not compared");
      continue;
    }
    INFO(key.second << " changed (processor kind " << key.first
                    << "). If that is meant, say in CHANGELOG.md what changed and why, and run "
                       "again with SPRINGLOD_BLESS=1");
    CHECK(hash == known->second);
  }
}

TEST_CASE("Runs of levels have the same bits whichever kernels OpenBLAS uses") {
  const char* const kCode = R"(
local s = require "springlod"
local chain = s.simplify(s.lattice(s.grid{cell = 0.02, size = {8, 8, 12},
  fill = function() return "rubber" end,
  materials = {rubber = {young = "0.5 MPa", density = 1100, damping_ratio = 0.02}}}),
  {levels = 1, keep = {0.2}, contact = "surface"})
local run = s.run(chain[1], {duration = 0.02, throw = {velocity = {2, 0, -1}, spin = {3, 1, 2}},
  obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}}}, {quiet = true})
assert(run.first_contact)
print(s.json(run.final.x)))";
  const auto printed = [&] {
    const Ran ran = springlod_run({"-e", kCode});
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    return ran.out;
  };
  const std::string usual = printed();
  for (const char* kernels : {"Nehalem", "Prescott"}) {
    setenv("OPENBLAS_CORETYPE", kernels, 1);
    const std::string other = printed();
    unsetenv("OPENBLAS_CORETYPE");
    CHECK((usual == other));
  }
}
