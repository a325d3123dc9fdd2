// One value of a type or a list of them as an argument.

#include "scripting/bind/tables/value_list.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/state.hpp"

using namespace springlod;
using namespace springlod::scripting;
using Catch::Matchers::Contains;

namespace {

/// A call of a function of one argument, `text` in Lua; `a` and `b` are models, `c` is a scenario.
class OneArgument {
 public:
  explicit OneArgument(const std::string& text) {
    lua_State* L = state_.lua();
    global("a", std::make_shared<const ModelValue>());
    global("b", std::make_shared<const ModelValue>());
    global("c", std::make_shared<const sim::Scenario>());
    lua_settop(L, 0);
    REQUIRE(luaL_dostring(L, ("return " + text).c_str()) == LUA_OK);
  }
  std::size_t models() {
    Call call(state_.lua(), entry_);
    return values_at<ModelValue>(call, 1, "a Model, or a list of Models").size();
  }
  bool begins() {
    Call call(state_.lua(), entry_);
    return begins_with<ModelValue>(call, 1);
  }

 private:
  template <class T>
  void global(const char* name, std::shared_ptr<const T> value) {
    push(state_.lua(), std::move(value));
    lua_setglobal(state_.lua(), name);
  }
  ScriptState state_{{}, make_api()};
  FunctionEntry entry_{.name = "draw", .arguments = {{.name = "models", .type = "Model"}}};
};

}  // namespace

TEST_CASE("a value and a list of values are read alike") {
  CHECK(OneArgument("a").models() == 1);
  CHECK(OneArgument("{a}").models() == 1);
  CHECK(OneArgument("{a, b, a}").models() == 3);
  CHECK(OneArgument("a").begins());
  CHECK(OneArgument("{a, c}").begins());
  CHECK_FALSE(OneArgument("c").begins());
  CHECK_FALSE(OneArgument("{c, a}").begins());
  CHECK_FALSE(OneArgument("{}").begins());
  CHECK_FALSE(OneArgument("'a'").begins());
}

TEST_CASE("lists with other values and empty lists are refused with the entry at fault") {
  const auto refused = [](const std::string& text, const std::string& message) {
    CHECK_THROWS_AS(OneArgument(text).models(), InputError);
    CHECK_THROWS_WITH(OneArgument(text).models(),
                      Contains("draw: expected a Model, or a list of Models") && Contains(message));
  };
  refused("c", "got a Scenario");
  refused("3", "got 3");
  refused("{}", "(this one is empty)");
  refused("{x = a}", "(this one is empty)");
  refused("{a, c}", "(entry 2 is a Scenario)");
  refused("{a, b, 'c'}", "(entry 3 is a string)");
}
