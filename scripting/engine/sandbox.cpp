#include "scripting/engine/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include <lua.hpp>

#include "scripting/engine/script_error.hpp"
#include "scripting/engine/session.hpp"

namespace springlod::scripting {

namespace {

// The mode of load and its like that refuses bytecode, which can crash the interpreter.
constexpr const char* kText = "t";

FileAccess& files_of(lua_State* L) {
  return session_of(L).files();
}

// Calls the function in upvalue 1 with all arguments.
int call_original(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

void require(lua_State* L, const char* path, bool writing) {
  protect(L, [&]() -> int {
    writing ? files_of(L).require_writable(path) : files_of(L).require_readable(path);
    return 0;
  });
}

// ---------------------------------------------------------------- files

// What io.open and os.remove return for a file that the system refuses.
int give_refusal(lua_State* L, const char* path) {
  lua_pushnil(L);
  lua_pushfstring(L, "%s: not allowed to this script (see springlod --unsafe)", path);
  lua_pushinteger(L, EACCES);
  return 3;
}

int open_file(lua_State* L) {
  const char* path = luaL_checkstring(L, 1);
  const bool writing = std::strpbrk(luaL_optstring(L, 2, "r"), "wa+") != nullptr;
  const bool allowed = writing ? files_of(L).may_write(path) : files_of(L).may_read(path);
  return allowed ? call_original(L) : give_refusal(L, path);
}

// io.lines and io.input
int read_from(lua_State* L) {
  if (lua_type(L, 1) == LUA_TSTRING) require(L, lua_tostring(L, 1), false);
  return call_original(L);
}

// io.output
int write_to(lua_State* L) {
  if (lua_type(L, 1) == LUA_TSTRING) require(L, lua_tostring(L, 1), true);
  return call_original(L);
}

// os.remove and os.rename
int change_files(lua_State* L) {
  for (int i = 1; i <= lua_gettop(L); ++i) {
    const char* path = luaL_checkstring(L, i);
    if (!files_of(L).may_write(path)) return give_refusal(L, path);
  }
  return call_original(L);
}

int name_temporary(lua_State* L) {
  const int count = call_original(L);
  if (count > 0 && lua_type(L, 1) == LUA_TSTRING) files_of(L).allow_named(lua_tostring(L, 1));
  return count;
}

// ---------------------------------------------------------------- code

// load(chunk, name, mode, environment)
int load_text(lua_State* L) {
  if (lua_gettop(L) < 3) lua_settop(L, 3);
  lua_pushstring(L, kText);
  lua_replace(L, 3);
  return call_original(L);
}

// loadfile(path, mode, environment)
int load_file(lua_State* L) {
  require(L, luaL_checkstring(L, 1), false);
  if (lua_gettop(L) < 2) lua_settop(L, 2);
  lua_pushstring(L, kText);
  lua_replace(L, 2);
  return call_original(L);
}

int do_file(lua_State* L) {
  const char* path = luaL_checkstring(L, 1);
  lua_settop(L, 1);
  require(L, path, false);
  if (luaL_loadfilex(L, path, kText) != LUA_OK) return lua_error(L);
  lua_call(L, 0, LUA_MULTRET);
  return lua_gettop(L) - 1;
}

// The searcher of files on package.path, for text in allowed files. Upvalue 1: package.
int search_file(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  lua_getfield(L, lua_upvalueindex(1), "searchpath");
  lua_pushstring(L, name);
  lua_getfield(L, lua_upvalueindex(1), "path");
  lua_call(L, 2, 2);
  if (lua_isnil(L, -2)) return 1;  // where it has looked
  lua_pop(L, 1);
  const char* path = lua_tostring(L, -1);
  require(L, path, false);
  if (luaL_loadfilex(L, path, kText) != LUA_OK)
    return luaL_error(L, "cannot load module '%s' from %s: %s", name, path, lua_tostring(L, -1));
  lua_pushstring(L, path);
  return 2;
}

// Finalizers run where nothing can stop them.
int set_metatable(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);  // the original would not know its name
  if (lua_type(L, 2) == LUA_TTABLE) {
    lua_pushstring(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL)
      return luaL_error(L, "a script has no finalizers (__gc); use a variable with <close>");
    lua_pop(L, 1);
  }
  return call_original(L);
}

// ---------------------------------------------------------------- the libraries

// Replaces field `name` of the table on top by a function that has the former value as upvalue.
void wrap(lua_State* L, const char* name, lua_CFunction function) {
  lua_getfield(L, -1, name);
  lua_pushcclosure(L, function, 1);
  lua_setfield(L, -2, name);
}

void remove(lua_State* L, const char* name) {
  lua_pushnil(L);
  lua_setfield(L, -2, name);
}

int refuse_call(lua_State* L) {
  return luaL_error(L, "%s is closed to scripts; springlod --unsafe opens it",
                    lua_tostring(L, lua_upvalueindex(1)));
}

// As remove, but a call names the remedy.
void close(lua_State* L, const char* library, const char* name) {
  lua_pushfstring(L, "%s.%s", library, name);
  lua_pushcclosure(L, refuse_call, 1);
  lua_setfield(L, -2, name);
}

void close_io(lua_State* L) {
  lua_getglobal(L, LUA_IOLIBNAME);
  wrap(L, "open", open_file);
  wrap(L, "lines", read_from);
  wrap(L, "input", read_from);
  wrap(L, "output", write_to);
  close(L, LUA_IOLIBNAME, "popen");
  lua_pop(L, 1);
  // A script could exchange the finalizer of files.
  luaL_getmetatable(L, LUA_FILEHANDLE);
  lua_pushstring(L, "file");
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

void close_os(lua_State* L) {
  lua_getglobal(L, LUA_OSLIBNAME);
  wrap(L, "remove", change_files);
  wrap(L, "rename", change_files);
  wrap(L, "tmpname", name_temporary);
  close(L, LUA_OSLIBNAME, "execute");
  close(L, LUA_OSLIBNAME, "setlocale");  // numbers would be read and written in another way
  lua_pop(L, 1);
}

void close_base(lua_State* L) {
  lua_pushglobaltable(L);
  wrap(L, "load", load_text);
  wrap(L, "loadfile", load_file);
  wrap(L, "dofile", do_file);
  wrap(L, "setmetatable", set_metatable);
  lua_pop(L, 1);
}

// The folders that package.path names before any script has run: of the system and the user.
void allow_modules(lua_State* L, std::string_view path) {
  while (!path.empty()) {
    const std::string_view pattern = path.substr(0, path.find(';'));
    const std::string_view folder = pattern.substr(0, pattern.find('?'));
    if (folder.starts_with('/')) files_of(L).allow_modules(folder);
    path.remove_prefix(std::min(path.size(), pattern.size() + 1));
  }
}

void close_package(lua_State* L) {
  lua_getglobal(L, LUA_LOADLIBNAME);
  close(L, LUA_LOADLIBNAME, "loadlib");
  remove(L, "cpath");
  lua_getfield(L, -1, "path");
  allow_modules(L, lua_tostring(L, -1));
  lua_pop(L, 1);
  lua_getfield(L, -1, "searchers");
  // 1 looks into package.preload, 2 for Lua files, 3 and 4 for native libraries.
  for (const int native : {4, 3}) {
    lua_pushnil(L);
    lua_rawseti(L, -2, native);
  }
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, search_file, 1);
  lua_rawseti(L, -2, 2);
  lua_pop(L, 2);
}

void close_debug(lua_State* L) {
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_createtable(L, 0, 1);
  lua_getglobal(L, LUA_DBLIBNAME);
  lua_getfield(L, -1, "traceback");
  lua_setfield(L, -3, "traceback");
  lua_pop(L, 1);
  lua_pushvalue(L, -1);
  lua_setglobal(L, LUA_DBLIBNAME);
  lua_setfield(L, -2, LUA_DBLIBNAME);
  lua_pop(L, 1);
}

}  // namespace

void close_sandbox(lua_State* L) {
  close_base(L);
  close_io(L);
  close_os(L);
  close_package(L);
  close_debug(L);
}

}  // namespace springlod::scripting
