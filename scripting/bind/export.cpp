// Models as files of other programs.

#include "report/export/export.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Assets";

/// A Model, or the level of a chain that the options name.
std::shared_ptr<const ModelValue> exported_model(Call& call, TableReader& options) {
  std::uint32_t level = 0;
  options.read("level", level);
  if (const auto chain = call.try_value<ChainValue>(2)) return level_value(chain, level);
  const auto model = call.try_value<ModelValue>(2);
  if (!model) call.refuse(2, "a LodChain or a Model");
  if (options.has("level")) options.refuse("level", "given for a chain only: a Model is one level");
  return model;
}

std::string origin_of(const ModelValue& value) {
  return fmt::format("springlod {}: {} nodes, {} springs, level {}", version(),
                     value.model->node_count(), value.model->spring_count(), value.level);
}

void push_report(lua_State* L, const report::ExportReport& written) {
  std::vector<std::string> files;
  for (const std::filesystem::path& file : written.files) files.push_back(file.string());
  begin_table(L);
  set_field(L, "files", files);
  set_field(L, "settings", written.settings);
  set_field(L, "losses", written.losses);
}

int export_binding(Call& call) {
  TableReader options = call.options(3);
  report::ModelFormat format = report::ModelFormat::json;
  options.read("to", format);
  const auto value = exported_model(call, options);
  const std::filesystem::path path = call.writable(1);
  report::ExportedModel body{.model = *value->model};
  if (value->surface && value->surface_of_base) {
    body.surface = value->surface.get();
    body.surface_of_nodes = surface_binding(*value);
  }
  body.name = report::identifier(path.stem().string());
  options.read("name", body.name);
  body.origin = origin_of(*value);
  options.read("gravity", body.gravity);
  options.finish();
  if (body.name != report::identifier(body.name))
    options.refuse("name", "letters, digits and underscores");
  push_report(call.lua(), report::export_model(body, format, path));
  return 1;
}

}  // namespace

void describe_export(Api& api) {
  api.add(FunctionEntry{
      .name = "export",
      .group = kGroup,
      .summary = "Writes a level as a file of another program, with the settings that keep it "
                 "stable and right there.",
      .arguments = {{.name = "path",
                     .type = "string",
                     .help = "file to write; without the ending of the format, its stem"},
                    {.name = "model", .type = "LodChain or Model", .help = "what to write"}},
      .options = {{.name = "to",
                   .type = "one of",
                   .help = "format",
                   .choices = words_of<report::ModelFormat>()},
                  {.name = "level",
                   .type = "integer",
                   .range = Range{0, 1000},
                   .fallback = "0, the base",
                   .help = "level of the chain"},
                  {.name = "name",
                   .type = "string",
                   .fallback = "from the path",
                   .help = "name of the body in the file: letters, digits and underscores"},
                  {.name = "gravity",
                   .type = "list of 3 numbers",
                   .fallback = "{0, 0, -9.81}",
                   .help = "acceleration that the settings reckon with [m/s2]"}},
      .returns = "table: files, the paths that were written; settings, lines that say which step, "
                 "iterations and damping keep the body stable and right; losses, lines that say "
                 "what the format does not hold",
      .errors = "A level that the chain does not have; a model that the format cannot hold; a file "
                "cannot be written.",
      .example =
          "local written = s.export(\"out/dumbbell.json\", chain, {to = \"json\", level = 1})\n"
          "print(table.concat(written.losses, \"\\n\"))",
      .call = export_binding});
}

}  // namespace springlod::scripting
