#include "scripting/engine/script_error.hpp"

#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "base/script_number.hpp"
#include "scripting/engine/session.hpp"

namespace springlod::scripting {

std::string call_site(lua_State* L) {
  lua_Debug frame{};
  for (int level = 0; lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    // Frames of bindings have no line.
    if (frame.currentline > 0) return fmt::format("{}:{}: ", frame.short_src, frame.currentline);
  }
  return "";
}

void describe_errors(Api& api) {
  TypeBuilder<ErrorValue> type(
      "Error value of a failed springlod function, as pcall returns it; tostring(error) is the "
      "line of the script and the message.",
      [](const ErrorValue& error) { return error.where + error.message; });
  type.field("message", "string", "cause, place and remedy, without the line of the script",
             [](const ErrorValue& error) { return error.message; });
  type.field("where", "string", "line of the script, \"script.lua:12: \"",
             [](const ErrorValue& error) { return error.where; });
  type.field("kind", "string",
             "\"input\" (a value or option is wrong), \"io\" (a file), \"unstable\" (a simulation "
             "diverged), \"tunnelled\" (a node passed through an obstacle), \"interrupted\" "
             "(Ctrl-C), \"memory\" or \"internal\"",
             [](const ErrorValue& error) { return error.kind; });
  type.table_field("node", "integer",
                   "first node that diverged or passed through an obstacle; nil for other errors",
                   [](lua_State* L, const ErrorValue& error) {
                     error.node ? push(L, *error.node) : lua_pushnil(L);
                   });
  type.table_field("time", "number", "simulated time of that event [s]; nil for other errors",
                   [](lua_State* L, const ErrorValue& error) {
                     error.time ? push(L, *error.time) : lua_pushnil(L);
                   });
  type.table_field("obstacle", "string",
                   "name of the obstacle that a node passed through; nil for other errors",
                   [](lua_State* L, const ErrorValue& error) {
                     error.obstacle ? push(L, *error.obstacle) : lua_pushnil(L);
                   });
  api.add(type.build());
}

std::shared_ptr<const ErrorValue> current_error(lua_State* L) {
  auto error = std::make_shared<ErrorValue>();
  error->where = call_site(L);
  try {
    throw;
  } catch (const InterruptedError& e) {
    error->kind = "interrupted";
    error->message = e.what();
  } catch (const UnstableError& e) {
    error->kind = "unstable";
    error->message = e.what();
    error->node = static_cast<long long>(script_number(e.node()));
    error->time = e.time();
  } catch (const TunnelError& e) {
    error->kind = "tunnelled";
    error->message = e.what();
    error->node = static_cast<long long>(script_number(e.node()));
    error->time = e.time();
    error->obstacle = e.obstacle();
  } catch (const IoError& e) {
    error->kind = "io";
    error->message = e.what();
  } catch (const InputError& e) {
    error->kind = "input";
    error->message = e.what();
  } catch (const std::bad_alloc&) {
    error->kind = "memory";
    error->message = "out of memory; take larger cells or fewer levels, frames or starts";
  } catch (const std::filesystem::filesystem_error& e) {
    error->kind = "io";
    error->message = e.what();
  } catch (const std::exception& e) {
    error->kind = "internal";
    error->message = fmt::format("internal error: {}; please report it", e.what());
  }
  error->message = session_of(L).console().flag_words().in_flags(printable(error->message));
  return error;
}

void raise(lua_State* L, std::shared_ptr<const ErrorValue> error) {
  push(L, std::move(error));
  lua_error(L);
  throw std::logic_error("lua_error came back");
}

void raise_interrupted(lua_State* L) {
  auto error = std::make_shared<ErrorValue>();
  error->kind = "interrupted";
  error->message = "interrupted";
  error->where = call_site(L);
  raise(L, std::move(error));
}

}  // namespace springlod::scripting
