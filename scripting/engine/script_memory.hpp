#pragma once

#include <cstdint>

struct lua_State;

namespace springlod::scripting {

/// A limit on the memory of the values of a Lua state. Beyond it, Lua collects garbage and then
/// raises "not enough memory". Values of the API, such as models, count by their Lua handles alone.
class ScriptMemory {
 public:
  explicit ScriptMemory(std::uint64_t limit) : limit_(limit) {}  // [bytes]
  ScriptMemory(const ScriptMemory&) = delete;
  ScriptMemory& operator=(const ScriptMemory&) = delete;
  /// From now on, `L` takes its memory from here; this must outlive it.
  void serve(lua_State* L);

 private:
  static void* allocate(void* self, void* block, std::size_t old_size, std::size_t size);

  std::uint64_t limit_;
  std::uint64_t used_ = 0;
};

}  // namespace springlod::scripting
