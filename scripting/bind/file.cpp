// Whole files: writing text, and hashing content. Folders that one run has for itself.

#include "base/file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/folder_claim.hpp"
#include "base/temporary_file.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "scripting/engine/interrupt.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Session";

int save_text(Call& call) {
  write_text_file(call.writable(1), call.text(2));
  return 0;
}

int hash(Call& call) {
  TableReader options = call.options(1);
  std::optional<std::string> file, text;
  options.read("file", file);
  options.read("text", text);
  options.finish();
  if (file) call.session().files().require_readable(*file);
  if (file.has_value() == text.has_value()) throw InputError("hash: give either file or text");
  return call.give(content_hash(file ? read_file(*file) : *text));
}

int same_file(Call& call) {
  std::error_code missing;
  return call.give(std::filesystem::equivalent(call.readable(1), call.readable(2), missing));
}

constexpr const char* kUsualCommand = "script";

struct FolderUse {
  std::string command = kUsualCommand;
  bool resumes = false;
};

std::string continuing_text(const std::string& folder, const FolderUse& use) {
  return use.resumes
             ? fmt::format("{}: continuing an unfinished run of springlod {}", folder, use.command)
             : fmt::format(
                   "{}: the last run of springlod {} did not finish; its files are "
                   "replaced",
                   folder, use.command);
}

std::string interrupted_text(const std::string& folder, const FolderUse& use) {
  return use.resumes
             ? fmt::format(
                   "{} holds what has been computed; run the same command again to "
                   "continue",
                   folder)
             : fmt::format("{} is unfinished; run the same command again to replace it", folder);
}

int in_folder(Call& call) {
  const std::filesystem::path folder = call.writable(1);
  lua_State* L = call.lua();
  if (!lua_isfunction(L, call.index(2))) call.refuse(2, "a function");
  FolderUse use;
  TableReader options = call.options(3);
  options.read("command", use.command);
  options.read("resumes", use.resumes);
  options.finish();
  FolderClaim claim(folder, use.command);
  remove_stale_temporaries(folder);
  Console& console = call.session().console();
  if (claim.continues()) console.say(continuing_text(folder.string(), use));
  const int bottom = lua_gettop(L);
  lua_pushvalue(L, call.index(2));
  try {
    lua_call(L, 0, LUA_MULTRET);
  } catch (...) {
    if (interrupt_requested()) console.say(interrupted_text(folder.string(), use));
    throw;
  }
  claim.finish();
  return lua_gettop(L) - bottom;
}

}  // namespace

void describe_files(Api& api) {
  api.add(FunctionEntry{
      .name = "save_text",
      .group = kGroup,
      .summary =
          "Writes text to a file. An existing file is replaced only when the new one is complete.",
      .arguments = {{.name = "path",
                     .type = "string",
                     .help = "file to write; missing folders are created"},
                    {.name = "text", .type = "string", .help = "content of the file"}},
      .returns = "nothing",
      .errors = "The file cannot be written.",
      .example = "s.save_text(\"out/info.json\", s.json(s.info(chain)))",
      .call = save_text});
  api.add(FunctionEntry{
      .name = "hash",
      .group = kGroup,
      .summary = "Hashes the content of a file, or text, with xxh3 (64 bits): the same content "
                 "gives the same hash.",
      .options = {{.name = "file",
                   .type = "string",
                   .fallback = "none",
                   .help = "path of the file to hash"},
                  {.name = "text",
                   .type = "string",
                   .range = Range{0, 1e9},
                   .fallback = "none",
                   .help = "text to hash"}},
      .returns = "string: 16 hexadecimal digits",
      .errors = "The file cannot be read; both options or none are given.",
      .example = "print(s.hash{file = \"out/dumbbell.glb\"})",
      .call = hash});
  api.add(FunctionEntry{
      .name = "same_file",
      .group = kGroup,
      .summary =
          "Whether two paths lead to one file, also through links. Files that do not exist are "
          "never the same.",
      .arguments = {{.name = "a", .type = "string", .help = "a path"},
                    {.name = "b", .type = "string", .help = "a path"}},
      .returns = "boolean",
      .errors = "None.",
      .example = "assert(not s.same_file(\"dumbbell.obj\", \"out/dumbbell.glb\"))",
      .call = same_file});
  api.add(FunctionEntry{
      .name = "in_folder",
      .group = kGroup,
      .summary =
          "Calls a function that writes files to a folder, which no other run may use meanwhile. "
          "The folder remembers the command, and whether it has finished. Missing folders are "
          "created; if the function fails before it writes anything, they are removed again.",
      .arguments = {{.name = "folder", .type = "string", .help = "folder to write to"},
                    {.name = "work", .type = "function", .help = "function without arguments"}},
      .options = {{.name = "command",
                   .type = "string",
                   .fallback = fmt::format("\"{}\"", kUsualCommand),
                   .help = "name of what writes to the folder"},
                  {.name = "resumes",
                   .type = "boolean",
                   .fallback = "false",
                   .help = "whether the function uses what an earlier, unfinished run has left; "
                           "only changes messages"}},
      .returns = "what the function returns",
      .errors = "Another run uses the folder; it holds files of another command; it cannot be "
                "written to; and those of the function.",
      .example = "s.in_folder(\"out/bars\", function()\n"
                 "  s.save_text(\"out/bars/readme.txt\", \"three bars\\n\")\nend, "
                 "{command = \"bars\"})",
      .call = in_folder});
}

}  // namespace springlod::scripting
