#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <typeindex>

#include "scripting/engine/console.hpp"
#include "scripting/engine/file_access.hpp"

struct lua_State;

namespace springlod::scripting {

class Api;

/// Settings of the command line.
struct Settings {
  std::uint64_t seed = 1;
  std::uint32_t threads = 0;  ///< 0: all cores
  Verbosity verbosity = Verbosity::normal;
  bool sandbox = true;                                   ///< FileAccess and close_sandbox
  bool portable = false;                                 ///< the same results on every processor
  double time_limit = 0;                                 ///< InterruptHandler [s]; 0: none
  std::uint64_t script_memory = std::uint64_t{4} << 30;  ///< ScriptMemory [bytes]
};

/// State shared by all bindings of one Lua state.
class Session {
 public:
  Session(Settings settings, const Api& api);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Settings& settings() const { return settings_; }
  const Api& api() const { return api_; }
  Console& console() { return console_; }
  Progress* progress() { return &console_; }
  FileAccess& files() { return files_; }
  /// State that bindings keep between calls: one T, created on first use.
  template <class T>
  T& kept() {
    std::any& slot = kept_[typeid(T)];
    if (!slot.has_value()) slot = std::make_shared<T>();
    return **std::any_cast<std::shared_ptr<T>>(&slot);
  }

 private:
  Settings settings_;
  Console console_;
  FileAccess files_;
  const Api& api_;
  std::map<std::type_index, std::any> kept_;
};

/// The session of a Lua state, shared with its coroutines.
Session& session_of(lua_State* L);
void set_session(lua_State* L, Session* session);

/// Version of springlod, "0.1.0".
std::string version();

}  // namespace springlod::scripting
