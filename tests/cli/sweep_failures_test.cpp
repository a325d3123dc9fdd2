// What stops a sweep: a full disk, a folder that may not be written to, no cluster. It is named, no
// finished unit is lost, and when the cause is gone the results are those of a quiet run.

#include <map>

#include <catch2/catch.hpp>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include "base/subprocess.hpp"
#include "tests/cli/csv_rows.hpp"
#include "tests/cli/sweep_scratch.hpp"

using Catch::Matchers::Contains;
using springlod::find_program;
using springlod::ProgramResult;
using springlod::run_program;
using springlod::test::slurp;
using springlod::test::spit;

namespace fs = std::filesystem;

namespace {

// 40 units. The results of the first six are small files, the others take two pages each.
const char* const kTexts = R"(
local s = require "springlod"
return s.sweep{count = 40, columns = {"text"}, unit = function(point)
  return {text = ("x"):rep(point.index > 6 and 6000 or 10) .. point.index}
end})";

const std::string kProgram = (springlod::test::build_folder() / "app/springlod").string();

/// A sweep that is to be disturbed, and the merged results of a quiet run.
class Texts : public springlod::test::SweepScratch {
 public:
  Texts() : SweepScratch(kTexts) {
    plan("quiet");
    must({"run", "quiet"});
    expected_ = merged("quiet");
  }
  /// Runs springlod as an argument of another program.
  ProgramResult run_by(const std::vector<std::string>& before,
                       const std::vector<std::string>& arguments) const {
    std::vector<std::string> words(before.begin() + 1, before.end());
    words.insert(words.end(), {kProgram, "sweep"});
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_program(before.front(), words, path());
  }
  /// The results that are there, by file.
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> all;
    const fs::path folder = path() / out / "results/0000";
    if (fs::exists(folder))
      for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        all[entry.path().filename()] = slurp(entry.path());
    return all;
  }
  /// After the cause is gone.
  void check_end(const std::string& out, const std::map<std::string, std::string>& kept) const {
    CHECK_THAT(must({"resume", out}), Contains("40 of 40 units done"));
    CHECK(merged(out) == expected_);
    const auto now = results(out);
    for (const auto& [name, text] : kept) {
      CAPTURE(name);
      CHECK(now.at(name) == text);  // with the time that it took: it was not run again
    }
  }

 private:
  std::string expected_;
};

/// For those who are not root: runs the current test again as the root of a namespace of its own,
/// if the system lets them have one. Returns whether it has.
bool tested_in_namespace() {
  const auto unshare = find_program("unshare");
  if (::geteuid() == 0 || !unshare) return false;
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"--user", "--map-root-user", "--mount"});
    return run_program(*unshare, words);
  };
  if (run({"true"}).exit_code != 0) return false;
  const ProgramResult ran = run({fs::read_symlink("/proc/self/exe").string(),
                                 Catch::getResultCapture().getCurrentTestName()});
  CAPTURE(ran.output);
  CHECK(ran.exit_code == 0);
  return true;
}

/// Whether this process may mount file systems, which others then do not see.
bool may_mount() {
  static const bool may = ::unshare(CLONE_NEWNS) == 0 &&
                          ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
  return may;
}

/// A small file system in memory.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, const std::string& options) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    is_there_ = may_mount() && ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  ~SmallDisk() {
    if (is_there_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_there() const { return is_there_; }
  void change(const std::string& options, unsigned long flags = 0) const {
    REQUIRE(::mount(nullptr, folder_.c_str(), nullptr, MS_REMOUNT | flags, options.c_str()) == 0);
  }

 private:
  fs::path folder_;
  bool is_there_ = false;
};

constexpr const char* kNoMount =
    "this user may not mount a file system here (in most containers nobody may): left out";

}  // namespace

TEST_CASE("A full disk stops a sweep and loses nothing") {
  if (tested_in_namespace()) return;
  const Texts texts;
  const SmallDisk disk(texts / "disk", "size=160k");
  if (!disk.is_there()) {
    WARN(kNoMount);
    return;
  }
  texts.plan("disk/out");
  const auto ran = texts.run({"run", "disk/out"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("No space left on device") && Contains("Finished units are kept") &&
                          Contains("springlod sweep resume disk/out"));
  const auto kept = texts.results("disk/out");
  CHECK(kept.size() >= 6);
  CHECK(kept.size() < 40);
  for (const auto& [name, text] : kept) CHECK_THAT(name, Catch::EndsWith(".json"));

  // Not even the logs can be written now.
  const auto again = texts.run({"resume", "disk/out"});
  CAPTURE(again.err);
  CHECK(again.exit_code == 1);
  CHECK_THAT(again.err, Contains("No space left on device"));
  const auto merge = texts.run({"merge", "disk/out"});
  CHECK(merge.exit_code == 1);
  CHECK_THAT(merge.err, Contains("No space left on device") && Contains("merge again"));

  disk.change("size=8m");
  texts.check_end("disk/out", kept);
}

TEST_CASE("A limit of the size of files stops a sweep and loses nothing") {
  const Texts texts;
  texts.plan();
  // Blocks of 512 bytes, in some shells of 1024.
  const ProgramResult ran =
      texts.run_by({"/bin/sh", "-c", "trap '' XFSZ; ulimit -f 4; exec \"$@\"", "sh"},
                   {"run", "out", "--workers", "1"});
  CAPTURE(ran.errors);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.errors, Contains("0000006.json: File too large") &&
                             Contains("Finished units are kept") &&
                             Contains("springlod sweep resume out"));
  const auto kept = texts.results("out");
  CHECK(kept.size() == 6);
  texts.check_end("out", kept);
}

TEST_CASE("A folder without the right to write stops a sweep and loses nothing") {
  const Texts texts;
  // Root may write everywhere, but for the right that setpriv takes away.
  std::vector<std::string> before{"/usr/bin/env"};
  if (const auto setpriv = find_program("setpriv"); setpriv && ::geteuid() == 0)
    before = {setpriv->string(), "--bounding-set=-dac_override,-dac_read_search"};
  texts.plan();
  texts.must({"run", "out"});
  for (const char* name : {"0000003.json", "0000030.json"})
    fs::remove(texts / "out/results/0000" / name);
  const auto kept = texts.results("out");
  REQUIRE(kept.size() == 38);
  const auto let_write = [&](fs::perm_options change) {
    fs::permissions(texts / "out", fs::perms::owner_write, change);
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(texts / "out"))
      fs::permissions(entry.path(), fs::perms::owner_write, change);
  };
  let_write(fs::perm_options::remove);
  std::vector<std::string> words(before.begin() + 1, before.end());
  words.insert(words.end(), {"test", "-w", "out"});
  if (run_program(before.front(), words, texts.path()).exit_code == 0) {
    WARN("root may write everywhere, and setpriv cannot change that here: left out");
    return;
  }
  for (const char* action : {"run", "resume"}) {
    const ProgramResult ran = texts.run_by(before, {action, "out"});
    CAPTURE(action, ran.errors);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.errors, Contains("out/logs") && Contains("Permission denied") &&
                               Contains("Finished units are kept") &&
                               Contains("springlod sweep resume out"));
  }
  const ProgramResult submit = texts.run_by(before, {"submit", "out", "--dry-run"});
  CHECK(submit.exit_code == 1);
  CHECK_THAT(submit.errors, Contains("out/jobs: Permission denied"));
  const ProgramResult merge = texts.run_by(before, {"merge", "out"});
  CHECK(merge.exit_code == 1);
  CHECK_THAT(merge.errors, Contains("Permission denied") && Contains("merge again"));
  const ProgramResult status = texts.run_by(before, {"status", "out"});
  CHECK(status.exit_code == 0);
  CHECK_THAT(status.output, Contains("38 of 40 units done, 2 missing"));
  let_write(fs::perm_options::add);
  texts.check_end("out", kept);
}

TEST_CASE("A file system that may only be read stops a sweep and loses nothing") {
  if (tested_in_namespace()) return;
  const Texts texts;
  const SmallDisk disk(texts / "disk", "size=8m");
  if (!disk.is_there()) {
    WARN(kNoMount);
    return;
  }
  texts.plan("disk/out");
  texts.must({"run", "disk/out"});
  fs::remove(texts / "disk/out/results/0000/0000003.json");
  const auto kept = texts.results("disk/out");
  disk.change("size=8m", MS_RDONLY);
  const auto ran = texts.run({"resume", "disk/out"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("Read-only file system") && Contains("Finished units are kept"));
  disk.change("size=8m");
  texts.check_end("disk/out", kept);
}

TEST_CASE("Without a cluster, submit says what to do and loses nothing") {
  const Texts texts;
  texts.plan();
  texts.must({"run", "out"});
  fs::remove(texts / "out/results/0000/0000003.json");
  const auto kept = texts.results("out");
  const std::pair<const char*, std::string> kMessages[] = {
      {"slurm",
       "sbatch is not installed here: run this on a machine of the cluster from which "
       "jobs are submitted, or use --engine parallel"},
      {"parallel", "GNU parallel is not installed"},
  };
  for (const auto& [engine, message] : kMessages)
    for (const char* action : {"submit", "resume"}) {
      const ProgramResult ran =
          texts.run_by({"/usr/bin/env", "PATH=/nowhere"}, {action, "out", "--engine", engine});
      CAPTURE(action, ran.errors);
      CHECK(ran.exit_code == 1);
      CHECK_THAT(ran.errors, Contains(message));
    }
  texts.check_end("out", kept);
}

TEST_CASE("A damaged plan is made again, and nothing is lost") {
  const Texts texts;
  texts.plan();
  texts.must({"run", "out"});
  fs::remove(texts / "out/results/0000/0000003.json");
  const auto kept = texts.results("out");
  fs::resize_file(texts / "out/plan.json", 100);
  for (const char* action : {"status", "run", "resume", "submit", "merge"}) {
    const auto ran = texts.run({action, "out"});
    CAPTURE(action, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains("plan.json is damaged; make the plan again"));
  }
  // A plan with other results is refused nevertheless.
  const auto other = texts.run({"plan", "walk.lua", "--out", "out", "--", "argument"});
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.err, Contains("holds results of another plan"));
  SECTION("truncated") {
    texts.plan();
  }
  SECTION("removed") {
    fs::remove(texts / "out/plan.json");
    texts.plan();
  }
  texts.check_end("out", kept);
}

TEST_CASE("A unit that ends its process, or fails without a message, stops no other") {
  const springlod::test::SweepScratch scratch(R"(
return require("springlod").sweep{count = 4, columns = {"n"}, unit = function(point)
  if point.index == 1 then os.exit(3) end
  if point.index == 2 then error({}) end
  if point.index == 3 then error(("x"):rep(1000000)) end
  return {n = point.index}
end})");
  scratch.plan();
  CHECK_THAT(scratch.must({"run", "out"}), Contains("1 of 4 units done, 3 failed"));
  scratch.merged();
  const auto gaps = springlod::test::rows_of(slurp(scratch / "out/gaps.csv"));
  REQUIRE(gaps.size() == 3);
  CHECK(gaps[0].at("message") == "ended its process with exit code 3");
  CHECK(gaps[1].at("message") == "error with a table, not with a message");
  CHECK(gaps[2].at("message").size() < 3000);
}
