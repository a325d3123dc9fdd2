// Models as files of other programs.

#include "report/export/export.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <lua.hpp>

#include "report/export/motion.hpp"
#include "scripting/bind/tables/options.hpp"
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
  if (const auto chain = call.try_value<ChainValue>(2)) {
    const std::size_t coarsest = chain->chain.levels.size() - 1;
    if (level > coarsest) options.refuse("level", fmt::format("at most {}", coarsest));
    return level_value(chain, level);
  }
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

/// The model with its surface, and the name that the options or the path give it.
report::ExportedModel exported(const ModelValue& value, const std::filesystem::path& path,
                               TableReader& options) {
  report::ExportedModel body{.model = *value.model};
  if (value.surface && value.surface_of_base) {
    body.surface = value.surface.get();
    body.surface_of_nodes = surface_binding(value);
  }
  body.name = report::identifier(path.stem().string());
  options.read("name", body.name);
  if (body.name != report::identifier(body.name))
    options.refuse("name", "letters, digits and underscores");
  body.origin = origin_of(value);
  return body;
}

int export_binding(Call& call) {
  TableReader options = call.options(3);
  report::ModelFormat format = report::ModelFormat::json;
  options.read("to", format);
  const auto value = exported_model(call, options);
  const std::filesystem::path path = call.writable(1);
  report::ExportedModel body = exported(*value, path, options);
  options.read("gravity", body.gravity);
  options.finish();
  push_report(call.lua(), report::export_model(body, format, path));
  return 1;
}

int export_motion_binding(Call& call) {
  const auto run = call.value<TrajectoryValue>(2);
  TableReader reader = call.options(3);
  report::MotionOptions options;
  read_options(call, reader, options);
  const std::filesystem::path path = call.writable(1);
  const report::ExportedModel body = exported(*run->model, path, reader);
  reader.finish();
  push_report(call.lua(), report::export_motion({body, run->trajectory.frames}, path, options));
  return 1;
}

Parameter name_parameter() {
  return {.name = "name",
          .type = "string",
          .fallback = "from the path",
          .help = "name of the body in the file: letters, digits and underscores"};
}

std::vector<Parameter> motion_parameters() {
  std::vector<Parameter> parameters = parameters_of(report::MotionOptions{});
  parameters.push_back(name_parameter());
  return parameters;
}

constexpr const char* kReport =
    "table: files, the paths that were written; settings, lines that say what keeps the body "
    "stable and right there; losses, lines that say what the format does not hold";

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
                  name_parameter(),
                  {.name = "gravity",
                   .type = "{x, y, z}",
                   .dimension = Dimension::acceleration,
                   .fallback = "{0, 0, -9.81}",
                   .help = "acceleration that the settings reckon with"}},
      .returns = kReport,
      .errors = "A level that the chain does not have; a model that the format cannot hold; a file "
                "cannot be written.",
      .example =
          "local written = s.export(\"out/dumbbell.json\", chain, {to = \"json\", level = 1})\n"
          "print(table.concat(written.losses, \"\\n\"))",
      .call = export_binding});
  api.add(FunctionEntry{
      .name = "export_motion",
      .group = kGroup,
      .summary = "Writes the motion of a run as files of another program.",
      .arguments = {{.name = "path",
                     .type = "string",
                     .help = "file to write; without the ending of the format, its stem"},
                    {.name = "trajectory", .type = "Trajectory", .help = "result of run"}},
      .options = motion_parameters(),
      .returns = kReport,
      .errors = "A format that needs a surface, for a body without one; a level with more nodes "
                "than a skinned glb can number; a file cannot be written.",
      .example = "local run = s.run(chain[1], scene, {frame_rate = 30})\n"
                 "s.export_motion(\"out/fall.glb\", run, {to = \"glb\"})",
      .call = export_motion_binding});
}

}  // namespace springlod::scripting
