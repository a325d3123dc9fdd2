// Files as scripts write and compare them.

#include <cstdlib>

#include <catch2/catch.hpp>
#include <sys/wait.h>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

Ran run_lua(const TemporaryFolder& scratch, const std::string& code) {
  return springlod_run({"-q", "-e",
                        "local s = require 'springlod'\n"
                        "local folder = arg[1]\n" +
                            code,
                        (scratch / "").string()});
}

}  // namespace

TEST_CASE("text is saved byte for byte, in folders that need not be there") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    s.save_text(folder .. "new/deep/text", "old")
    s.save_text(folder .. "new/deep/text", "a\0b\r\n")
    print(#s.files(folder .. "new/deep"))
    print(pcall(s.save_text, folder .. "new/deep/text/below", "x")))");
  CAPTURE(ran.err);
  CHECK(slurp(scratch / "new" / "deep" / "text") == std::string("a\0b\r\n", 5));
  CHECK_THAT(ran.out, Contains("1\n") && Contains("cannot make the folder"));
}

TEST_CASE("the hash of a file is that of its text, and depends on every byte") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    s.save_text(folder .. "file", "a\0b")
    print(s.hash{file = folder .. "file"} == s.hash{text = "a\0b"},
          s.hash{text = "a\0b"} ~= s.hash{text = "a\0c"}, s.hash{text = ""})
    print(pcall(s.hash, {file = folder .. "none"}))
    print(pcall(s.hash, {}))
    print(pcall(s.hash, {file = "x", text = "y"})))");
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("true\ttrue\t2d06800538d394c2\n") && Contains("cannot read"));
  CHECK_THAT(ran.out, Contains("give either file or text"));
}

TEST_CASE("standard output that cannot be written is named, and a failure") {
  const TemporaryFolder scratch;
  const std::string errors = (scratch / "errors.txt").string();
  const std::string program = (springlod::test::build_folder() / "app/springlod").string();
  const int status = std::system((program + " -e 'print(1)' > /dev/full 2> " + errors).c_str());
  CHECK(WEXITSTATUS(status) == 1);
  CHECK_THAT(slurp(errors), Contains("cannot write all of the standard output"));
}

TEST_CASE("a closed standard output is a failure, and no file takes its place") {
  const TemporaryFolder scratch;
  spit(scratch / "write.lua", R"(
    local s = require "springlod"
    local folder = ...
    s.in_folder(folder, function()
      print(("noise"):rep(10000))
      s.save_text(folder .. "/text.txt", "text")
    end)
  )");
  const std::string errors = (scratch / "errors.txt").string();
  const std::string program = (springlod::test::build_folder() / "app/springlod").string();
  const int status = std::system((program + " run " + (scratch / "write.lua").string() + " -- " +
                                  (scratch / "out").string() + " >&- 2> " + errors)
                                     .c_str());
  CAPTURE(slurp(errors));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK_THAT(slurp(errors), Contains("cannot write all of the standard output"));
  CHECK(slurp(scratch / "out/text.txt") == "text");
  CHECK_THAT(slurp(scratch / "out/.springlod-run"), !Contains("noise"));
}

TEST_CASE("a folder that cannot be written to is named by every command") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.5"});
  spit(scratch / "drop.lua", "return {duration = 0.01}");
  const std::string asset = (scratch / "bar.glb").string();
  const std::string mesh = (scratch / "bar.obj").string();
  // /sys takes no files, of root neither.
  const std::vector<std::vector<std::string>> commands{
      {"convert", mesh, "--unit", "m", "--fast", "--cell", "0.5", "-o", "/sys/bar.glb"},
      {"convert", mesh, "--unit", "m", "--cell", "0.5", "-o", "/sys/bar.glb"},
      {"compare", asset, "--scenario", (scratch / "drop.lua").string(), "--out", "/sys"},
      {"stability", asset, "--quick", "--out", "/sys/out"},
      {"refinement", "/sys/out", "--quick"}};
  for (const std::vector<std::string>& command : commands) {
    const Ran ran = springlod_run(command);
    CAPTURE(command, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains("cannot") && Contains("/sys"));
    CHECK_THAT(ran.err, !Contains("internal error"));
  }
}

TEST_CASE("files that the system does not let grow are named, and nothing half is left") {
  const TemporaryFolder scratch;
  spit(scratch / "write.lua", R"(
    local s = require "springlod"
    local folder = ...
    local points = {}
    for i = 1, 20 do points[i] = {i, i * i % 7} end
    local cells = s.grid{cell = 1, size = {16, 16, 16}, materials = {m = {young = 1e6}},
                         fill = function(x, y, z) return (x * y + z) % 2 < 1 and "m" or nil end}
    local chain = s.simplify(s.lattice(cells), {levels = 1})
    local rows = {}
    for i = 1, 2000 do rows[i] = {i} end
    local writers = {
      ["b.csv"] = function(path) s.csv(path, rows, {columns = {"n"}}) end,
      ["a.glb"] = function(path) s.save(path, chain) end,
      ["b.png"] = function(path) s.render(path, chain[1], {width = 400, height = 300}) end,
      ["a.png"] = function(path) s.chart(path, {{name = "a", points = points}}) end,
      ["a.svg"] = function(path) s.chart(path, {{name = "a", points = points}}) end,
      ["a.txt"] = function(path) s.save_text(path, ("x"):rep(100000)) end,
      ["a.vdb"] = function(path) s.save_vdb(path, cells) end,
    }
    for name, write in pairs(writers) do
      local old = assert(io.open(folder .. "/old-" .. name, "w"))
      old:write("old"):close()
      assert(not pcall(write, folder .. "/old-" .. name))
      assert(io.open(folder .. "/old-" .. name):read("a") == "old", name .. " was lost")
      local ok, failure = pcall(write, folder .. "/" .. name)
      assert(not ok, name .. " was written")
      assert(failure.message:find(name, 1, true), failure.message)
      assert(not io.open(folder .. "/" .. name), name .. " is left")
    end
    for _, path in ipairs(s.files(folder)) do
      assert(not path:find(".springlod-", 1, true), path .. " is left")
    end
  )");
  const std::string errors = (scratch / "errors.txt").string();
  const std::string program = (springlod::test::build_folder() / "app/springlod").string();
  // 8 blocks of 512 bytes: a shell's ulimit.
  const int status =
      std::system(("ulimit -f 8; " + program + " -q run " + (scratch / "write.lua").string() +
                   " -- " + scratch.path().string() + " 2> " + errors)
                      .c_str());
  CAPTURE(slurp(errors));
  CHECK(WEXITSTATUS(status) == 0);
}
