// springlod sweep on a private Slurm cluster and with GNU parallel, where they are installed.

#include <chrono>
#include <cstdlib>
#include <thread>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "base/subprocess.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::find_program;
using springlod::run_program;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const char* const kSweep = R"(
local s = require "springlod"
return s.sweep{stages = {
  {name = "make", count = 3, columns = {"size"}, unit = function(point)
    s.save_text("made-" .. s.seed .. "/" .. point.index .. ".txt", tostring(10 * point.index))
    return {size = point.index}
  end},
  {name = "use", axes = {{"which", {3, 2, 1}}, {"factor", {0.1, 0.3}}}, columns = {"value"},
   cost = function() return 1e11 end,
   unit = function(point)
    local file <close> = assert(io.open("made-" .. s.seed .. "/" .. point.which .. ".txt"))
    return {value = point.factor * tonumber(file:read("a"))}
  end},
}})";

void must(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"-q", "sweep"});
  const Ran ran = springlod_run(arguments, "", folder.path());
  CAPTURE(arguments, ran.err, ran.out);
  REQUIRE(ran.exit_code == 0);
}

std::string at_home(const TemporaryFolder& folder) {
  spit(folder / "sweep.lua", kSweep);
  must(folder, {"plan", "sweep.lua", "--out", "home"});
  must(folder, {"run", "home"});
  must(folder, {"merge", "home"});
  return slurp(folder / "home/results-use.csv");
}

/// Whether the private cluster can be started.
bool has_cluster() {
  const bool has = find_program("slurmctld") && find_program("munged") && ::geteuid() == 0;
  if (!has) WARN("Slurm is not installed (./dev setup sweep), or this is not root: left out");
  return has;
}

/// munged runs as a user of its own, who must get there.
void let_munge_through(const TemporaryFolder& folder) {
  fs::permissions(folder.path(), fs::perms::others_exec | fs::perms::others_read,
                  fs::perm_options::add);
}

/// The private cluster, for programs that this one starts.
class Cluster {
 public:
  explicit Cluster(const TemporaryFolder& folder) : folder_((folder / "cluster").string()) {
    let_munge_through(folder);
    const springlod::ProgramResult started = control({"start", folder_, "17017"});
    CAPTURE(started.errors);
    REQUIRE(started.exit_code == 0);
    ::setenv("SLURM_CONF", (folder_ + "/slurm.conf").c_str(), 1);
  }
  ~Cluster() {
    ::unsetenv("SLURM_CONF");
    control({"stop", folder_});
  }
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  /// Those that have not ended, a line each.
  std::string jobs() const {
    const springlod::ProgramResult queue = run_program(*find_program("squeue"), {"--noheader"});
    return queue.exit_code == 0 ? queue.output : queue.errors;
  }

 private:
  static springlod::ProgramResult control(const std::vector<std::string>& arguments) {
    return run_program(springlod::test::source_folder() / "tests/sweep/slurm_cluster", arguments);
  }
  std::string folder_;
};

}  // namespace

TEST_CASE("GNU parallel gives the same results as one machine", "[long]") {
  if (!find_program("parallel")) {
    WARN("GNU parallel is not installed (./dev setup sweep): left out");
    return;
  }
  const TemporaryFolder folder;
  const std::string expected = at_home(folder);
  must(folder, {"plan", "sweep.lua", "--out", "parallel"});
  must(folder, {"submit", "parallel", "--engine", "parallel"});
  must(folder, {"merge", "parallel"});
  CHECK(slurp(folder / "parallel/results-use.csv") == expected);
  fs::remove(folder / "parallel/results/0000/0000004.json");
  spit(folder / "hosts.txt", ":\n");
  must(folder, {"resume", "parallel", "--engine", "parallel", "--hosts", "hosts.txt"});
  must(folder, {"merge", "parallel"});
  CHECK(slurp(folder / "parallel/results-use.csv") == expected);
}

TEST_CASE("What is given to Slurm is printed first if asked for") {
  const TemporaryFolder folder;
  spit(folder / "sweep.lua", kSweep);
  must(folder, {"plan", "sweep.lua", "--out", "out"});
  const Ran ran = springlod_run(
      {"sweep", "submit", "out", "--dry-run", "--at-once", "5", "--sbatch=--partition=long"}, "",
      folder.path());
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  // The stages, one after the other, then the merge.
  CHECK_THAT(ran.out, Contains("job1=$(sbatch --parsable --requeue") && Contains("--array=0-0%5") &&
                          Contains("--partition=long") &&
                          Contains("\"--dependency=afterany:${job1%%;*}\"") &&
                          Contains("--signal=B:TERM@60") && Contains("sweep merge"));
}

TEST_CASE("Timed units have a machine to themselves") {
  const TemporaryFolder folder;
  std::string timed = kSweep;
  const std::size_t at = timed.find("cost = function");
  REQUIRE(at != std::string::npos);
  timed.insert(at, "alone = true, timings = {'value'}, ");
  spit(folder / "sweep.lua", timed);
  must(folder, {"plan", "sweep.lua", "--out", "out"});
  const auto printed = [&](const std::string& engine) {
    const Ran ran = springlod_run({"sweep", "submit", "out", "--dry-run", "--engine", engine}, "",
                                  folder.path());
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    return ran.out;
  };
  CHECK_THAT(printed("slurm"), Contains("--exclusive"));
  CHECK_THAT(printed("parallel"), Contains("--jobs 1"));
  must(folder, {"run", "out"});
  must(folder, {"merge", "out"});
  CHECK_THAT(slurp(folder / "out/results-use.csv"), !Contains("value"));
  CHECK_THAT(slurp(folder / "out/timings-use.csv"), Contains("which,factor,value"));
}

TEST_CASE("A wrong partition is named, and nothing is lost", "[long]") {
  if (!has_cluster()) return;
  const TemporaryFolder folder;
  const std::string expected = at_home(folder);
  const Cluster cluster(folder);
  must(folder, {"plan", "sweep.lua", "--out", "out"});
  must(folder, {"run", "out", "--task", "0"});
  const fs::path result = folder / "out/results/0000/0000002.json";
  const std::string kept = slurp(result);
  for (const std::vector<std::string>& action :
       {std::vector<std::string>{"submit", "out"}, {"resume", "out", "--engine", "slurm"}}) {
    std::vector<std::string> arguments = action;
    arguments.insert(arguments.begin(), "sweep");
    arguments.emplace_back("--sbatch=--partition=nowhere");
    const Ran ran = springlod_run(arguments, "", folder.path());
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains("invalid partition specified: nowhere") &&
                            Contains("none was submitted: submit again with other options"));
  }
  CHECK(cluster.jobs().empty());
  CHECK(slurp(result) == kept);
  must(folder, {"resume", "out", "--engine", "slurm", "--sbatch=--partition=short", "--at-once",
                "2", "--time", "10min", "--memory", "100000000"});
  // The last job merges.
  for (int i = 0; i < 1200 && !cluster.jobs().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(cluster.jobs().empty());
  CHECK(slurp(folder / "out/results-use.csv") == expected);
  CHECK(slurp(result) == kept);
}

TEST_CASE("Killed tasks of Slurm change no result", "[long]") {
  if (!has_cluster()) return;
  const TemporaryFolder folder;
  let_munge_through(folder);
  const springlod::ProgramResult result =
      run_program(springlod::test::source_folder() / "tests/sweep/kills",
                  {(springlod::test::build_folder() / "app/springlod").string(),
                   (folder / "kills").string(), "5", "1", "task", "worker"});
  CAPTURE(result.output, result.errors);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("the same results as at home"));
}
