#include "scripting/engine/state.hpp"

#include <algorithm>
#include <cctype>
#include <new>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/paths.hpp"
#include "scripting/engine/sandbox.hpp"
#include "scripting/engine/script_error.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

// Lua instructions between two checks of the Ctrl-C flag: about 0.1 ms, without measurable cost.
constexpr int kHookInterval = 10000;

void interrupt_hook(lua_State* L, lua_Debug* /*where*/) {
  if (!interrupt_requested()) return;
  // Checks at every instruction from now on, so that `while true do pcall(f) end` stops too.
  lua_sethook(L, interrupt_hook, LUA_MASKCOUNT, 1);
  raise_interrupted(L);
}

// Message handler of every call: returns the error value and stores the traceback and its place.
constexpr const char* kTraceback = "springlod.traceback";
constexpr const char* kPlace = "springlod.place";

int keep_traceback(lua_State* L) {
  push(L, call_site(L));
  lua_setfield(L, LUA_REGISTRYINDEX, kPlace);
  luaL_traceback(L, L, nullptr, 1);
  lua_setfield(L, LUA_REGISTRYINDEX, kTraceback);
  return 1;
}

bool are_equal_but_for_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char one, unsigned char other) {
                      return std::tolower(one) == std::tolower(other);
                    });
}

/// Of a name that is the one of a type, "mesh": which functions return one; else empty.
std::string makers_hint(const Api& api, std::string_view name) {
  std::string type;
  std::vector<std::string> makers;
  for (const FunctionEntry& entry : api.functions()) {
    const std::string returned = entry.returns.substr(0, entry.returns.find_first_of(" :"));
    if (!are_equal_but_for_case(returned, name)) continue;
    type = returned;
    makers.push_back("s." + entry.name);
  }
  if (makers.empty()) return "";
  return fmt::format("; a {} comes from {}", type, fmt::join(makers, ", "));
}

// Reports an unknown name when it is read, instead of "attempt to call a nil value" later.
int refuse_name(lua_State* L) {
  return protect(L, [L]() -> int {
    const std::string name = luaL_tolstring(L, 2, nullptr);
    lua_pop(L, 1);
    std::vector<std::string> names;
    for (const FunctionEntry& entry : session_of(L).api().functions()) names.push_back(entry.name);
    const std::string question = did_you_mean(name, names);
    const std::string hint = question.empty() ? makers_hint(session_of(L).api(), name) : question;
    throw InputError(fmt::format("springlod has no '{}'{}{} help() lists all names", name, hint,
                                 question.empty() ? ";" : ""));
  });
}

int open_module(lua_State* L) {
  const Api& api = session_of(L).api();
  lua_newtable(L);
  for (const FunctionEntry& entry : api.functions()) {
    push_function(L, entry);
    lua_setfield(L, -2, entry.name.c_str());
  }
  for (const ConstantEntry& constant : api.constants()) {
    constant.push(L);
    lua_setfield(L, -2, constant.parameter.name.c_str());
  }
  lua_createtable(L, 0, 1);
  lua_pushcfunction(L, refuse_name);
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
  return 1;
}

/// The text of the error value on top of the stack. Its __tostring may itself fail.
std::string text_of_error(lua_State* L) {
  lua_pushcfunction(L, [](lua_State* state) {
    luaL_tolstring(state, 1, nullptr);
    return 1;
  });
  lua_pushvalue(L, -2);
  std::string text = lua_pcall(L, 1, 1, 0) == LUA_OK ? lua_tostring(L, -1)
                                                     : "(an error value that cannot be shown)";
  lua_pop(L, 1);
  return text;
}

Outcome failed(lua_State* L, int status, bool with_traceback) {
  Outcome outcome;
  outcome.done = false;
  const auto error =
      std::static_pointer_cast<const ErrorValue>(boxed_at(L, -1, &kValueName<ErrorValue>));
  outcome.interrupted = error && error->kind == "interrupted";
  outcome.message = text_of_error(L);
  // Texts and the errors of springlod have their place; tables and other values have none.
  if (with_traceback && !error && lua_type(L, -1) != LUA_TSTRING) {
    lua_getfield(L, LUA_REGISTRYINDEX, kPlace);
    if (lua_isstring(L, -1) != 0) outcome.message = lua_tostring(L, -1) + outcome.message;
    lua_pop(L, 1);
  }
  if (status == LUA_ERRMEM)
    outcome.message += ": the script's own values need more than --memory-limit allows";
  lua_pop(L, 1);
  if (with_traceback && status != LUA_ERRMEM) {
    lua_getfield(L, LUA_REGISTRYINDEX, kTraceback);
    if (lua_isstring(L, -1) != 0) outcome.traceback = lua_tostring(L, -1);
    lua_pop(L, 1);
  }
  return outcome;
}

}  // namespace

std::string failure_text(ScriptState& state, const Outcome& outcome) {
  const bool verbose = state.session().settings().verbosity == Verbosity::verbose;
  return verbose && !outcome.traceback.empty() ? outcome.message + "\n" + outcome.traceback
                                               : outcome.message;
}

Session& session_of(lua_State* L) {
  return **static_cast<Session**>(lua_getextraspace(L));
}

Session::Session(Settings settings, const Api& api)
    : settings_(settings), console_(settings.verbosity), api_(api) {}

void set_session(lua_State* L, Session* session) {
  *static_cast<Session**>(lua_getextraspace(L)) = session;
}

std::string version() {
  return SPRINGLOD_VERSION;
}

ScriptState::ScriptState(const Settings& settings, std::unique_ptr<Api> api)
    : api_(std::move(api)),
      session_(std::make_unique<Session>(settings, *api_)),
      memory_(std::make_unique<ScriptMemory>(settings.script_memory)),
      lua_(luaL_newstate()) {
  if (lua_ == nullptr) throw std::bad_alloc();
  memory_->serve(lua_);
  set_session(lua_, session_.get());
  luaL_openlibs(lua_);
  if (settings.sandbox) {
    session_->files().restrict();
    session_->files().allow_project(std::filesystem::current_path());
    session_->files().allow_reading(sample_folder());
    session_->files().allow_reading(doc_folder());
    close_sandbox(lua_);
  }
  register_types(lua_, *api_);
  luaL_getsubtable(lua_, LUA_REGISTRYINDEX, LUA_PRELOAD_TABLE);
  lua_pushcfunction(lua_, open_module);
  lua_setfield(lua_, -2, "springlod");
  lua_pop(lua_, 1);
  push_function(lua_, *api_->find_function("help"));
  lua_setglobal(lua_, "help");
  add_search_folder(stock_script_folder());
}

ScriptState::~ScriptState() {
  lua_close(lua_);
}

void ScriptState::add_search_folder(const std::filesystem::path& folder) {
  session_->files().allow_reading(folder);
  lua_getglobal(lua_, "package");
  lua_getfield(lua_, -1, "path");
  const std::string path = fmt::format("{}/?.lua;{}", folder.string(), lua_tostring(lua_, -1));
  lua_pop(lua_, 1);
  push(lua_, path);
  lua_setfield(lua_, -2, "path");
  lua_pop(lua_, 1);
}

Outcome ScriptState::call(int argument_count, int result_count) {
  const int function = lua_gettop(lua_) - argument_count;
  lua_pushcfunction(lua_, keep_traceback);
  lua_insert(lua_, function);
  lua_sethook(lua_, interrupt_hook, LUA_MASKCOUNT, kHookInterval);
  const int status = lua_pcall(lua_, argument_count, result_count, function);
  lua_sethook(lua_, nullptr, 0, 0);
  lua_remove(lua_, function);
  return status == LUA_OK ? Outcome{} : failed(lua_, status, true);
}

Outcome ScriptState::run_loaded(int load_status, const std::string& name,
                                const std::vector<std::string>& arguments) {
  if (load_status != LUA_OK) return failed(lua_, load_status, false);
  luaL_checkstack(lua_, static_cast<int>(arguments.size()) + 8, "too many arguments");
  push(lua_, arguments);
  push(lua_, name);
  lua_rawseti(lua_, -2, 0);
  lua_setglobal(lua_, "arg");
  for (const std::string& argument : arguments) push(lua_, argument);
  return call(static_cast<int>(arguments.size()), 0);
}

Outcome ScriptState::run_file(const std::filesystem::path& path,
                              const std::vector<std::string>& arguments) {
  add_search_folder(path.has_parent_path() ? path.parent_path() : ".");
  return run_loaded(luaL_loadfilex(lua_, path.c_str(), "t"), path.string(), arguments);
}

Outcome ScriptState::run_text(std::string_view code, const std::string& name,
                              const std::vector<std::string>& arguments) {
  return run_loaded(luaL_loadbufferx(lua_, code.data(), code.size(), ("=" + name).c_str(), "t"),
                    name, arguments);
}

}  // namespace springlod::scripting
