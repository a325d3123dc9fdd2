#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/engine/api.hpp"
#include "scripting/engine/script_memory.hpp"
#include "scripting/engine/session.hpp"

struct lua_State;

namespace springlod::scripting {

/// Result of running a script.
struct Outcome {
  bool done = true;
  bool interrupted = false;
  std::string message;    ///< "script.lua:12: unknown option ..." if not done
  std::string traceback;  ///< "stack traceback: ..." if not done
};

class ScriptState;

/// The message of a failed outcome; under --verbose its traceback too.
std::string failure_text(ScriptState& state, const Outcome& outcome);

/// A Lua state with the standard libraries, `require "springlod"`, the global `help`, and a hook
/// that stops a running script after Ctrl-C. Not thread-safe.
class ScriptState {
 public:
  /// `api`: content of the module `require "springlod"`.
  ScriptState(const Settings& settings, std::unique_ptr<Api> api);
  ~ScriptState();
  ScriptState(const ScriptState&) = delete;
  ScriptState& operator=(const ScriptState&) = delete;

  /// Runs a file with `arguments` as its `...` and in the table `arg`. `require` also searches the
  /// folder of the script.
  Outcome run_file(const std::filesystem::path& path, const std::vector<std::string>& arguments);
  Outcome run_text(std::string_view code, const std::string& name,
                   const std::vector<std::string>& arguments);

  /// Calls the function below its `argument_count` arguments on the stack in protected mode. On
  /// success, its results are on the stack; on failure, the outcome has a traceback.
  Outcome call(int argument_count, int result_count);

  lua_State* lua() const { return lua_; }
  Session& session() { return *session_; }
  const Api& api() const { return *api_; }

 private:
  Outcome run_loaded(int load_status, const std::string& name,
                     const std::vector<std::string>& arguments);
  void add_search_folder(const std::filesystem::path& folder);

  std::unique_ptr<Api> api_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<ScriptMemory> memory_;
  lua_State* lua_;
};

}  // namespace springlod::scripting
