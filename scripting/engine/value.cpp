#include "scripting/engine/value.hpp"

#include <new>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/script_error.hpp"
#include "scripting/engine/suggest.hpp"

namespace springlod::scripting {

namespace {

struct Boxed {
  TypeTag tag;
  std::shared_ptr<const void> value;
};

std::string metatable_name(std::string_view type) {
  return fmt::format("springlod.{}", type);
}

Boxed* find_boxed(lua_State* L, int index, TypeTag tag) {
  if (lua_type(L, index) != LUA_TUSERDATA || lua_rawlen(L, index) != sizeof(Boxed)) return nullptr;
  auto* boxed = static_cast<Boxed*>(lua_touserdata(L, index));
  return boxed->tag == tag ? boxed : nullptr;
}

// The value of a metamethod call. The upvalue is its type; a direct call of the metamethod with
// another value raises an error.
std::shared_ptr<const void> self_of(lua_State* L, const TypeEntry& type) {
  std::shared_ptr<const void> self = boxed_at(L, 1, type.tag);
  if (self == nullptr)
    throw InputError(fmt::format("expected a {}, got {}", type.name, describe_type_at(L, 1)));
  return self;
}

const TypeEntry& type_upvalue(lua_State* L) {
  return *static_cast<const TypeEntry*>(lua_touserdata(L, lua_upvalueindex(1)));
}

int collect(lua_State* L) {
  Boxed* boxed = find_boxed(L, 1, type_upvalue(L).tag);
  if (boxed == nullptr) return 0;
  boxed->~Boxed();
  new (boxed) Boxed{nullptr, nullptr};  // so that a second, direct call finds a null pointer
  return 0;
}

int to_string(lua_State* L) {
  return protect(L, [L] {
    const TypeEntry& type = type_upvalue(L);
    push(L, type.describe(self_of(L, type).get()));
    return 1;
  });
}

int concatenate(lua_State* L) {
  luaL_tolstring(L, 1, nullptr);
  luaL_tolstring(L, 2, nullptr);
  lua_concat(L, 2);
  return 1;
}

int equal(lua_State* L) {
  const TypeTag tag = type_upvalue(L).tag;
  const std::shared_ptr<const void> a = boxed_at(L, 1, tag);
  push(L, a != nullptr && a == boxed_at(L, 2, tag));
  return 1;
}

int length(lua_State* L) {
  return protect(L, [L] {
    const TypeEntry& type = type_upvalue(L);
    push_integer(L, type.length(self_of(L, type).get()));
    return 1;
  });
}

int refuse_write(lua_State* L) {
  return protect(L, [L]() -> int {
    throw InputError(fmt::format("a {} cannot be changed; make a new one", type_upvalue(L).name));
  });
}

std::vector<std::string> member_names(const TypeEntry& type) {
  std::vector<std::string> names;
  for (const FieldEntry& field : type.fields) names.push_back(field.parameter.name);
  for (const FunctionEntry& method : type.methods) names.push_back(method.name);
  return names;
}

// Upvalues: the type, the table of its methods.
int index(lua_State* L) {
  return protect(L, [L] {
    const TypeEntry& type = type_upvalue(L);
    const std::shared_ptr<const void> self = self_of(L, type);
    if (type.index && lua_isinteger(L, 2) != 0) {
      if (!type.index(L, self, lua_tointeger(L, 2))) lua_pushnil(L);
      return 1;
    }
    const std::string name = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
    for (const FieldEntry& field : type.fields) {
      if (field.parameter.name != name) continue;
      field.push(L, self);
      return 1;
    }
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(2)) != LUA_TNIL) return 1;
    const std::vector<std::string> names = member_names(type);
    throw InputError(fmt::format("{} has no field '{}'{}", type.name,
                                 name.empty() ? describe_type_at(L, 2) : name,
                                 name_hint(name, names, type.name + " has")));
  });
}

void set_method(lua_State* L, const char* name, lua_CFunction function, const TypeEntry& type) {
  lua_pushlightuserdata(L, const_cast<TypeEntry*>(&type));
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

void register_type(lua_State* L, const TypeEntry& type) {
  luaL_newmetatable(L, metatable_name(type.name).c_str());
  push(L, type.name);
  lua_setfield(L, -2, "__name");
  push(L, type.name);
  lua_setfield(L, -2, "__metatable");  // getmetatable returns the name, setmetatable fails
  set_method(L, "__gc", collect, type);
  set_method(L, "__eq", equal, type);
  lua_pushcfunction(L, concatenate);
  lua_setfield(L, -2, "__concat");
  set_method(L, "__tostring", to_string, type);
  set_method(L, "__newindex", refuse_write, type);
  if (type.length) set_method(L, "__len", length, type);
  lua_pushlightuserdata(L, const_cast<TypeEntry*>(&type));
  lua_newtable(L);
  for (const FunctionEntry& method : type.methods) {
    push_function(L, method);
    lua_setfield(L, -2, method.name.c_str());
  }
  lua_pushcclosure(L, index, 2);
  lua_setfield(L, -2, "__index");
  lua_pop(L, 1);
}

}  // namespace

void push_boxed(lua_State* L, std::shared_ptr<const void> value, TypeTag tag) {
  void* memory = lua_newuserdatauv(L, sizeof(Boxed), 0);
  new (memory) Boxed{tag, std::move(value)};
  luaL_setmetatable(L, metatable_name(*tag).c_str());
}

std::shared_ptr<const void> boxed_at(lua_State* L, int index, TypeTag tag) {
  const Boxed* boxed = find_boxed(L, index, tag);
  return boxed == nullptr ? nullptr : boxed->value;
}

void register_types(lua_State* L, const Api& api) {
  for (const TypeEntry& type : api.types()) register_type(L, type);
}

std::string describe_type_at(lua_State* L, int index) {
  if (lua_isnoneornil(L, index)) return "nothing";
  if (lua_type(L, index) == LUA_TUSERDATA && luaL_getmetafield(L, index, "__name") == LUA_TSTRING) {
    const std::string name = lua_tostring(L, -1);
    lua_pop(L, 1);
    return fmt::format("a {}", name);
  }
  return fmt::format("a {}", luaL_typename(L, index));
}

void push(lua_State* L, bool value) {
  lua_pushboolean(L, value ? 1 : 0);
}
void push(lua_State* L, double value) {
  lua_pushnumber(L, value);
}
void push(lua_State* L, const std::string& value) {
  lua_pushlstring(L, value.data(), value.size());
}
void push(lua_State* L, const char* value) {
  lua_pushstring(L, value);
}
void push_integer(lua_State* L, long long value) {
  lua_pushinteger(L, value);
}

void push(lua_State* L, const Vec3& value) {
  lua_createtable(L, 3, 0);
  for (int axis = 0; axis < 3; ++axis) {
    lua_pushnumber(L, value[axis]);
    lua_rawseti(L, -2, axis + 1);
  }
}

void push(lua_State* L, const Mat3& value) {
  lua_createtable(L, 3, 0);
  for (int row = 0; row < 3; ++row) {
    push(L, Vec3(value.row(row)));
    lua_rawseti(L, -2, row + 1);
  }
}

void begin_list(lua_State* L, std::size_t count) {
  lua_createtable(L, static_cast<int>(count), 0);
}
void end_list_entry(lua_State* L, std::size_t number) {
  lua_rawseti(L, -2, static_cast<lua_Integer>(number));
}
void begin_table(lua_State* L) {
  lua_newtable(L);
}
void end_field(lua_State* L, const char* name) {
  lua_setfield(L, -2, name);
}

}  // namespace springlod::scripting
