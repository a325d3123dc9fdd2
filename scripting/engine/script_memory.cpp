#include "scripting/engine/script_memory.hpp"

#include <cstdlib>

#include <lua.hpp>

namespace springlod::scripting {

void ScriptMemory::serve(lua_State* L) {
  constexpr std::uint64_t kKilo = 1024;
  used_ = kKilo * static_cast<std::uint64_t>(lua_gc(L, LUA_GCCOUNT)) +
          static_cast<std::uint64_t>(lua_gc(L, LUA_GCCOUNTB));
  lua_setallocf(L, allocate, this);
}

// For a new block, Lua gives the kind of the value as its old size.
void* ScriptMemory::allocate(void* self, void* block, std::size_t old_size, std::size_t size) {
  auto& memory = *static_cast<ScriptMemory*>(self);
  const std::size_t freed = block == nullptr ? 0 : old_size;
  if (size == 0) {
    std::free(block);
    memory.used_ -= freed;
    return nullptr;
  }
  if (size > freed && memory.used_ + (size - freed) > memory.limit_) return nullptr;
  void* const moved = std::realloc(block, size);
  if (moved == nullptr) return nullptr;
  memory.used_ += size;
  memory.used_ -= freed;
  return moved;
}

}  // namespace springlod::scripting
