// Whole files: writing text, and hashing content.

#include "base/file.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

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
                  {.name = "text", .type = "string", .fallback = "none", .help = "text to hash"}},
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
}

}  // namespace springlod::scripting
