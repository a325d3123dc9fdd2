// Arguments and tables of options are checked against their descriptions.

#include "scripting/engine/call.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/state.hpp"

using namespace springlod;
using namespace springlod::scripting;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace {

enum class Way { slow, fast };

constexpr Choice<Way> kWays[] = {{Way::slow, "slow", "takes its time"}, {Way::fast, "fast", ""}};
constexpr Choice<Way> kOneWay[] = {{Way::slow, "slow", ""}};
constexpr ChoiceTable<Choice<Way>> choices(Way) {
  return {"way", kWays};
}

/// A reader of the Lua table `text` for a function "test".
class Options {
 public:
  Options(std::vector<Parameter> listed, const std::string& text) : listed_(std::move(listed)) {
    REQUIRE(luaL_dostring(state_.lua(), ("return " + text).c_str()) == LUA_OK);
    reader_.emplace(state_.lua(), lua_gettop(state_.lua()), listed_, "test");
  }
  TableReader* operator->() { return &*reader_; }

 private:
  ScriptState state_{{}, make_api()};
  std::vector<Parameter> listed_;
  std::optional<TableReader> reader_;
};

template <class T>
T read_as(const std::string& text, Dimension dimension = Dimension::number, T value = {}) {
  Options options({{.name = "x", .dimension = dimension}}, "{x = " + text + "}");
  options->read("x", value);
  options->finish();
  return value;
}

}  // namespace

TEST_CASE("Options are read by their type, omitted options keep their defaults") {
  CHECK(read_as<bool>("true"));
  CHECK(read_as<double>("2.5") == 2.5);
  CHECK(read_as<int>("-3") == -3);
  CHECK(read_as<std::string>("'text'") == "text");
  CHECK(read_as<Vec3>("{1, 2, 3}") == Vec3(1, 2, 3));
  CHECK(read_as<std::vector<std::string>>("{'a', 'b'}") == std::vector<std::string>{"a", "b"});
  CHECK(read_as<std::vector<double>>("{}").empty());
  CHECK(read_as<std::optional<double>>("1") == 1);
  CHECK(read_as<std::optional<double>>("nil") == std::nullopt);
  CHECK(read_as<double>("nil", Dimension::number, 7) == 7);
  CHECK(read_as<Colour>("'#ff0000'") == Colour{1, 0, 0});
  CHECK(read_as<Colour>("{0, 0.5, 1}") == Colour{0, 0.5F, 1});
}

TEST_CASE("Quantities are numbers in SI units or text with a unit of their dimension") {
  CHECK(read_as<double>("'5 mm'", Dimension::length) == Approx(0.005));
  CHECK(read_as<double>("0.25", Dimension::length) == 0.25);
  CHECK(read_as<double>("'2ms'", Dimension::time) == Approx(0.002));
  CHECK(read_as<double>("'1 MPa'", Dimension::pressure) == Approx(1e6));
  CHECK(read_as<Vec3>("{'1 cm', 2, '3 m'}", Dimension::length).isApprox(Vec3(0.01, 2, 3)));
  CHECK(read_as<std::vector<double>>("{'1 ms', 1}", Dimension::time).front() == Approx(1e-3));
  CHECK_THROWS_AS(read_as<double>("'5 kg'", Dimension::length), InputError);
  CHECK_THROWS_WITH(read_as<double>("{}", Dimension::length),
                    Contains("test: x must be a number (in m) or text with a unit, got a table"));
  CHECK_THROWS_WITH(read_as<double>("0/0"), Contains("x must be finite"));
  CHECK_THROWS_WITH(read_as<double>("1/0", Dimension::time), Contains("x must be finite"));
}

TEST_CASE("Values outside of the range of an option are refused, the ends are inside") {
  const auto read = [](auto value, const std::string& text, Dimension dimension, Range range) {
    Options options({{.name = "x", .dimension = dimension, .range = range}}, "{x = " + text + "}");
    options->read("x", value);
    return value;
  };
  const Range seconds{1e-3, 10};
  CHECK(read(0.0, "10", Dimension::time, seconds) == 10);
  CHECK(read(0.0, "'1 ms'", Dimension::time, seconds) == 1e-3);
  CHECK_THROWS_WITH(read(0.0, "'0.9 ms'", Dimension::time, seconds),
                    "test: x must be from 1 ms to 10 s, got 900 us");
  CHECK_THROWS_WITH(read(Vec3(), "{1, 2, 11}", Dimension::time, seconds), Contains("got 11 s"));
  CHECK_THROWS_WITH(read(std::vector<double>(), "{1, 0}", Dimension::time, seconds),
                    Contains("got 0 s"));
  CHECK(read(0, "5", Dimension::number, {1, 5}) == 5);
  CHECK_THROWS_WITH(read(0, "6", Dimension::number, {1, 5}),
                    "test: x must be a whole number of 1 to 5, got 6");
  CHECK_THROWS_WITH(read(std::vector<std::uint32_t>(), "{6}", Dimension::number, {1, 5}),
                    Contains("from 1 to 5, got 6"));
  CHECK(read(std::string(), "'abc'", Dimension::number, {0, 3}) == "abc");
  CHECK_THROWS_WITH(read(std::string(), "'abcd'", Dimension::number, {0, 3}),
                    "test: x must be text of at most 3 bytes, got 4");
}

TEST_CASE("Options without a range have the usual one, whole numbers that of their type") {
  CHECK(read_as<double>("1e15") == 1e15);
  CHECK_THROWS_WITH(read_as<double>("1e16"),
                    Contains("from -1000000000000000 to 1000000000000000"));
  CHECK_THROWS_WITH(read_as<std::string>("('x'):rep(4097)"), Contains("at most 4096 bytes"));
  CHECK(read_as<std::uint64_t>("math.maxinteger") == 0x7fffffffffffffff);
}

TEST_CASE("Errors for wrong values name the expected and the actual value") {
  CHECK_THROWS_WITH(read_as<bool>("1"), "test: x must be true or false, got 1");
  CHECK_THROWS_WITH(read_as<std::string>("{}"), "test: x must be text, got a table");
  CHECK_THROWS_WITH(read_as<int>("1.5"), "test: x must be a whole number, got 1.5");
  CHECK_THROWS_WITH(read_as<int>("'7'"), Contains("must be a whole number, got \"7\""));
  CHECK_THROWS_WITH(read_as<std::uint8_t>("300"),
                    "test: x must be a whole number of 0 to 255, got 300");
  CHECK_THROWS_WITH(read_as<std::uint64_t>("-1"),
                    "test: x must be a whole number, 0 or more, got -1");
  CHECK_THROWS_WITH(read_as<Vec3>("{1, 2}"), Contains("three numbers") && Contains("table of 2"));
  CHECK_THROWS_WITH(read_as<Vec3>("{1, 2, {}}"), Contains("x[3] must be a number"));
  CHECK_THROWS_WITH(read_as<std::vector<std::string>>("{'a', 2}"), Contains("entry 2 is 2"));
  CHECK_THROWS_WITH(read_as<std::vector<double>>("{1, 'a'}"), Contains("x[2]"));
  for (const char* colour : {"'#ff00'", "'red'", "'#gg0000'"})
    CHECK_THROWS_WITH(read_as<Colour>(colour), Contains("\"#rrggbb\" or {r, g, b}"));
  CHECK_THROWS_WITH(read_as<Colour>("{0, 0, 2}"), Contains("of 0..1"));
}

TEST_CASE("Choices accept only the listed words") {
  const std::vector<Parameter> listed{{.name = "way", .choices = words_of<Way>()}};
  Way way = Way::slow;
  Options fast(listed, "{way = 'fast'}");
  fast->read("way", way);
  CHECK(way == Way::fast);
  Options wrong(listed, "{way = 'fats'}");
  CHECK_THROWS_WITH(wrong->read("way", way),
                    "test: way must be one of slow, fast, got \"fats\"; did you mean 'fast'?");
  Options unlisted(listed, "{}");
  CHECK_THROWS_AS(unlisted->choose("way", way, ChoiceTable<Choice<Way>>("way", kOneWay)),
                  std::logic_error);
}

TEST_CASE("Unknown keys and entries without a key are errors") {
  const std::vector<Parameter> listed{{.name = "size"}, {.name = "speed"}};
  CHECK_THROWS_WITH(Options(listed, "{sped = 1}"),
                    "unknown option 'sped'; did you mean 'speed'? test takes: size, speed");
  CHECK_THROWS_WITH(Options(listed, "{3}"), Contains("options need names, but 1 has none"));
  CHECK_THROWS_WITH(Options(listed, "3"), Contains("expected a table of options such as {size ="));
  CHECK_NOTHROW(Options(listed, "nil"));
}

TEST_CASE("An unknown option that another function of the call takes is named with that function") {
  ScriptState state({}, make_api());
  const auto refused = [&](const std::string& call) {
    const Outcome outcome = state.run_text(
        "local s = require 'springlod'\n"
        "local base = s.model{nodes = {{0, 0, 0, mass = 1}}}\n" +
            call,
        "test", {});
    CHECK_FALSE(outcome.done);
    return outcome.message;
  };
  // The call takes it, beside the table.
  CHECK_THAT(refused("s.run(base, {anchored = {1}})"),
             EndsWith("unknown option 'anchored'; it is an option of run: "
                      "s.run(model, scenario, {anchored = ...})"));
  CHECK_THAT(refused("s.run(base, {throw = {frame_rate = 1}})"),
             EndsWith("; it is an option of run: s.run(model, scenario, {frame_rate = ...})"));
  // Functions take it that take the result of the call.
  CHECK_THAT(refused("s.scenario{anchored = {1}}"),
             Contains("unknown option 'anchored'; it is an option of run, ") &&
                 Contains("compare") && EndsWith(": s.run(model, scenario, {anchored = ...})"));
  // No function of the call takes these.
  CHECK_THAT(refused("s.scenario{gravty = {0, 0, 0}}"),
             Contains("unknown option 'gravty'; did you mean 'gravity'? scenario takes: name, "));
  CHECK_THAT(refused("s.run(base, {cell = 1})"),
             Contains("unknown option 'cell'; scenario takes: name, "));
}

TEST_CASE(
    "A binding that reads unregistered options, or omits registered ones, throws logic_error") {
  Options options({{.name = "size"}, {.name = "speed"}}, "{size = 1}");
  double value = 0;
  CHECK_THROWS_AS(options->read("colour", value), std::logic_error);
  CHECK(options->has("size"));
  CHECK_THROWS_AS(options->finish(), std::logic_error);
  CHECK_FALSE(options->has("speed"));
  CHECK_NOTHROW(options->finish());
}

TEST_CASE("Arguments are checked by number and type, and errors name them") {
  ScriptState state({}, make_api());
  lua_State* L = state.lua();
  FunctionEntry entry{
      .name = "grow", .arguments = {{.name = "size"}, {.name = "name"}}, .call = [](Call& call) {
        const long long size = call.integer(1, 0, 9);
        const std::string name = call.text(2);
        return call.give(size + 1, name + "!", size, call.has(2));
      }};
  push_function(L, entry);
  CHECK(entry_of_function(L, -1) == &entry);
  lua_setglobal(L, "grow");
  lua_getglobal(L, "print");
  CHECK(entry_of_function(L, -1) == nullptr);
  lua_pop(L, 1);

  CHECK(
      state
          .run_text("local a, b, c, d = grow(2, 'x') assert(a == 3 and b == 'x!' and c == 2 and d)",
                    "test", {})
          .done);
  const auto refused = [&](const std::string& call) {
    const Outcome outcome = state.run_text(call, "test", {});
    CHECK_FALSE(outcome.done);
    return outcome.message;
  };
  CHECK_THAT(
      refused("grow('a', 'x')"),
      Contains("bad argument 1 (size) of grow: expected a whole number of 0 to 9, got \"a\""));
  CHECK_THAT(refused("grow(2)"), Contains("bad argument 2 (name) of grow: expected text"));
  CHECK_THAT(refused("grow(20, 'x')"), Contains("a whole number of 0 to 9"));
  CHECK_THAT(refused("grow(1, 'x', 3)"),
             Contains("grow takes 2 arguments, got 3; try help(\"grow\")"));
}

TEST_CASE("Script errors have the kind of their cause") {
  ScriptState state({}, make_api());
  FunctionEntry entry{
      .name = "fail", .arguments = {{.name = "cause"}}, .call = [](Call& call) -> int {
        const std::string cause = call.text(1);
        if (cause == "input") throw InputError("said");
        if (cause == "io") throw IoError("said");
        if (cause == "unstable") throw UnstableError("said", 4, 0.5);
        if (cause == "tunnelled") throw TunnelError("said", 4, "wall", 0.5);
        if (cause == "interrupted") throw InterruptedError();
        if (cause == "memory") throw std::bad_alloc();
        throw std::logic_error("said");
      }};
  push_function(state.lua(), entry);
  lua_setglobal(state.lua(), "fail");
  const Outcome outcome = state.run_text(
      "for _, cause in ipairs{'input', 'io', 'unstable', 'tunnelled', 'interrupted', 'memory',\n"
      "                       'internal'} do\n"
      "  local ok, failure = pcall(fail, cause)\n"
      "  assert(not ok and failure.kind == cause, cause)\n"
      "  local ran = cause == 'unstable' or cause == 'tunnelled'\n"
      "  assert((failure.node == 5) == ran and (failure.time == 0.5) == ran, cause)\n"
      "  assert((failure.obstacle == 'wall') == (cause == 'tunnelled'), cause)\n"
      "end",
      "test", {});
  CHECK(outcome.message.empty());
}
