// What scripts may do, by the real program.

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

namespace springlod::test {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

// In an empty folder, so that nothing else is allowed.
Ran run_code(const std::string& code, const TemporaryFolder& scratch,
             std::vector<std::string> flags = {}) {
  fs::create_directories(scratch / "project");
  flags.insert(flags.end(), {"-e", code});
  return springlod_run(flags, "", scratch / "project");
}

TEST_CASE("a script starts no other program and loads no native code") {
  const TemporaryFolder scratch;
  const Ran ran = run_code(R"lua(
    for _, call in ipairs{"os.execute", "io.popen", "package.loadlib", "os.setlocale"} do
      local library, name = call:match("(%a+)%.(%a+)")
      local ok, message = pcall(_G[library][name], "id")
      assert(not ok and message:find(call .. " is closed", 1, true), message)
      assert(message:find("--unsafe", 1, true))
    end
    assert(package.cpath == nil and #package.searchers == 2)
    local ok, message = pcall(require, "no.such.module")
    assert(not ok and message:find("no field package.preload"))
  )lua",
                           scratch);
  CHECK(ran.err == "");
  CHECK(ran.exit_code == 0);
}

TEST_CASE("a script has no debug library, no bytecode and no finalizers") {
  const TemporaryFolder scratch;
  const Ran ran = run_code(R"lua(
    assert(debug == require "debug" and debug.traceback():find("stack traceback"))
    for name in pairs(debug) do assert(name == "traceback", name) end
    local code = string.dump(function() end)
    for _, mode in ipairs{"b", "bt", false} do
      local chunk, message = load(code, "code", mode or nil)
      assert(not chunk and message:find("attempt to load a binary chunk"))
    end
    local file = io.open("code.luac", "wb")
    file:write(code)
    file:close()
    assert(not loadfile("code.luac", "b"))
    assert(not pcall(dofile, "code.luac"))
    assert(load("return x", "text", "bt", {x = 5})() == 5)
    assert(load("return 7")() == 7)
    local ok, message = pcall(setmetatable, {}, {__gc = print})
    assert(not ok and message:find("finalizers"))
    assert(getmetatable(setmetatable({}, {__index = {a = 1}})).__index.a == 1)
    assert(getmetatable(io.stdout) == "file")
    assert(tostring(io.stdout):find("^file %("))
  )lua",
                           scratch);
  CHECK(ran.err == "");
  CHECK(ran.exit_code == 0);
}

TEST_CASE("a script uses the files of the current folder, and no others") {
  const TemporaryFolder scratch;
  spit(scratch / "secret.txt", "secret");
  spit(scratch / "secret.lua", "return 'secret'");
  fs::create_directories(scratch / "project");
  fs::create_symlink(scratch / "secret.txt", scratch / "project/link.txt");
  const Ran ran = run_code(R"lua(
    local s = require "springlod"
    local function refused(f, ...)
      local ok, value, message = pcall(f, ...)
      message = tostring(ok and message or value)
      assert(not (ok and value) and (message:find("--unsafe", 1, true)), message)
    end
    for _, path in ipairs{"../secret.txt", "link.txt", "/etc/passwd", ".hidden", "a/.git/hooks/x"} do
      refused(io.open, path)
      refused(io.open, path, "w")
      refused(io.open, path, "a")
      refused(io.open, path, "r+")
      refused(io.lines, path)
      refused(io.input, path)
      refused(io.output, path)
      refused(os.remove, path)
      refused(os.rename, path, "x")
      refused(os.rename, "x", path)
      refused(s.save_text, path, "text")
      refused(s.hash, {file = path})
      refused(s.import, path)
      refused(s.load, path)
      refused(s.load_vdb, path)
      refused(s.csv, path, {{1}})
    end
    local ok, message = pcall(s.save_text, "name\0.txt", "text")
    assert(not ok and tostring(message):find("zero byte"))
    refused(dofile, "../secret.lua")
    refused(loadfile, "../secret.lua")
    refused(s.files, "..")
    package.path = "../?.lua"
    refused(require, "secret")

    s.save_text("new/file.txt", "mine")
    assert(io.open("new/file.txt"):read("a") == "mine")
    assert(os.rename("new/file.txt", "other.txt"))
    for line in io.lines("other.txt") do assert(line == "mine") end
    assert(os.remove("other.txt"))
    s.save_text("module.lua", "return 3")
    assert(dofile("module.lua") == 3 and loadfile("module.lua")() == 3)
    package.path = "./?.lua"
    assert(require "module" == 3)
    local name = os.tmpname()
    io.open(name, "w"):close()
    assert(os.remove(name))
    assert(dofile(s.samples .. "/ball_materials.lua").core)
  )lua",
                           scratch);
  CHECK(ran.err == "");
  CHECK(ran.exit_code == 0);
  CHECK(slurp(scratch / "secret.txt") == "secret");
}

TEST_CASE("files that the command line names are open to the script") {
  const TemporaryFolder scratch;
  fs::create_directories(scratch / "project");
  spit(scratch / "code/write.lua",
       "local beside = dofile((arg[0]:gsub('write', 'beside')))\n"
       "for _, path in ipairs(arg) do\n"
       "  local file = assert(io.open((path:gsub('^%-[%-%a]*=?', '')), 'w'))\n"
       "  file:write(beside)\n"
       "  file:close()\n"
       "end\n");
  spit(scratch / "code/beside.lua", "return 'written'");
  const std::string script = (scratch / "code/write.lua").string();
  const std::vector<std::string> names{"plain", "joined", "option"};
  const Ran ran = springlod_run(
      {"run", script, "--", (scratch / names[0]).string(), "-o" + (scratch / names[1]).string(),
       "--out=" + (scratch / names[2]).string()},
      "", scratch / "project");
  CHECK(ran.err == "");
  CHECK(ran.exit_code == 0);
  for (const std::string& name : names) CHECK(slurp(scratch / name) == "written");
}

TEST_CASE("the flag --unsafe opens programs and all files") {
  const TemporaryFolder scratch;
  spit(scratch / "outside.txt", "outside");
  const Ran ran = run_code(R"lua(
    assert(io.popen("echo started"):read("l") == "started")
    assert(io.open("../outside.txt"):read("a") == "outside")
    assert(debug.getinfo(1))
  )lua",
                           scratch, {"--unsafe"});
  CHECK(ran.err == "");
  CHECK(ran.exit_code == 0);
}

TEST_CASE("the values of a script have a limit of memory") {
  const TemporaryFolder scratch;
  const Ran ran =
      run_code("local t = {} for i = 1, 1e9 do t[i] = i end", scratch, {"--memory-limit", "50MB"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("not enough memory") && Contains("--memory-limit"));
  const Ran caught =
      run_code("assert(not pcall(string.rep, 'x', 60e6)) assert(#string.rep('x', 20e6) == 20e6)",
               scratch, {"--memory-limit", "50MB"});
  CHECK(caught.err == "");
  CHECK(caught.exit_code == 0);
}

TEST_CASE("a time limit stops a script that catches every error") {
  const TemporaryFolder scratch;
  const Ran ran = run_code("while true do pcall(function() while true do end end) end", scratch,
                           {"--time-limit", "100 ms"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("the time limit is over (--time-limit)"));
  CHECK(springlod_run({"--time-limit", "soon", "-e", ""}).exit_code == 2);
  CHECK(springlod_run({"--memory-limit", "much", "-e", ""}).exit_code == 2);
}

TEST_CASE("a stop ends calls of Lua that never look at it") {
  const std::string pattern = "local s = ('a'):rep(60) s:find(('.-'):rep(30) .. 'b')";
  const Ran interrupted =
      springlod_interrupted({"-e", "io.stderr:write('going\\n') " + pattern}, "going\n");
  CHECK(interrupted.exit_code == 130);
  CHECK_THAT(interrupted.err, Contains("springlod: interrupted"));
  const TemporaryFolder scratch;
  const Ran limited = run_code(pattern, scratch, {"--time-limit", "100 ms"});
  CHECK(limited.exit_code == 1);
  CHECK_THAT(limited.err, Contains("the time limit is over"));
}

}  // namespace
}  // namespace springlod::test
