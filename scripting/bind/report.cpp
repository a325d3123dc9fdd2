// Animations, videos, charts and tables.

#include <fmt/format.h>
#include <lua.hpp>

#include "base/progress.hpp"
#include "report/animate.hpp"
#include "report/chart.hpp"
#include "report/csv.hpp"
#include "report/gnuplot.hpp"
#include "report/map_picture.hpp"
#include "report/run_chart.hpp"
#include "report/video.hpp"
#include "scripting/bind/tables/chart_table.hpp"
#include "scripting/bind/tables/comparisons.hpp"
#include "scripting/bind/tables/draw_style.hpp"
#include "scripting/bind/tables/labelled_runs.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/value_list.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"
#include "sim/study/stability_map.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Pictures and reports";

constexpr const char* kComparisons = "a Comparison, or a list of Comparisons";
constexpr const char* kRuns = "a Trajectory, or a list of Trajectories";

int give_film(Call& call, const report::Animation& film) {
  return call.give(film.frames, film.frame_rate);
}

int animate_binding(Call& call) {
  report::AnimateOptions options;
  TableReader reader = call.options(3);
  read_options(call, reader, options);
  read_style(call, reader, options.style);
  options.progress = call.progress();
  if (begins_with<TrajectoryValue>(call, 2)) {
    const auto values = values_at<TrajectoryValue>(call, 2, kRuns);
    if (reader.has("levels"))
      reader.refuse("levels", "given for comparisons only: a run is that of one level");
    const auto runs = labelled_runs(values, reader);
    reader.finish();
    return give_film(call, report::animate(report::filmed_runs(runs), call.writable(1), options));
  }
  const auto comparisons =
      values_at<ComparisonValue>(call, 2, "a Comparison, a Trajectory, or a list of either");
  refuse_labels(reader, "the option variant of compare is part of the labels of levels");
  reader.finish();
  return give_film(call, report::animate(compared_chains(comparisons), call.writable(1), options));
}

int video_binding(Call& call) {
  double frame_rate = report::kUsualFrameRate;
  TableReader reader = call.options(3);
  reader.read("frame_rate", frame_rate);
  reader.finish();
  const Task task(call.progress(), "encoding the video", 0);
  const report::VideoResult video =
      report::encode_video(call.readable(2), frame_rate, call.writable(1));
  if (!video.made)
    call.session().console().say("no video: ffmpeg is not installed; with it, run\n  " +
                                 video.command);
  return call.give(video.made, video.command);
}

/// For charts of other data than runs.
void refuse_run_options(TableReader& reader) {
  refuse_labels(reader, "other series have names of their own");
  if (reader.has("quantity"))
    reader.refuse("quantity", "given for Trajectories only; give other data as series of points");
}

int give_drawn(Call& call, const report::Drawing& drawing) {
  if (!drawing.drawn)
    call.session().console().say("no chart: gnuplot is not installed; with it, run\n  " +
                                 drawing.command);
  return call.give(drawing.drawn, drawing.command);
}

int chart_binding(Call& call) {
  const Task task(call.progress(), "drawing the chart", 0);
  report::ChartOptions options;
  TableReader reader = call.options(3);
  const bool of_runs = begins_with<TrajectoryValue>(call, 2);
  if (!of_runs) refuse_run_options(reader);
  if (const auto map = call.try_value<sim::StabilityMap>(2)) {
    read_chart_options(call, reader, options);
    reader.finish();
    return give_drawn(call, report::draw_map(*map, options.title, call.writable(1)));
  }
  std::vector<report::ChartSeries> series;
  if (of_runs) {
    const auto values = values_at<TrajectoryValue>(call, 2, kRuns);
    const auto runs = labelled_runs(values, reader);
    report::RunQuantity quantity = report::RunQuantity::height;
    reader.read("quantity", quantity);
    series = report::run_series(runs, quantity);
    options = report::run_chart(runs, quantity);
  } else if (begins_with<ComparisonValue>(call, 2)) {
    const auto comparisons = values_at<ComparisonValue>(call, 2, kComparisons);
    series = cost_error_series(comparisons, reader);
    options = cost_error_chart(*comparisons.front());
  } else {
    series = series_from_table(call, call.index(2));
  }
  read_chart_options(call, reader, options);
  reader.finish();
  const report::ChartFiles files = report::draw_chart(series, options, call.writable(1));
  return give_drawn(call, {files.drawn, files.command});
}

int csv_binding(Call& call) {
  TableReader reader = call.options(3);
  const report::Table table = table_from_rows(call, call.index(2), reader);
  reader.finish();
  report::save_csv(table, call.writable(1));
  return 0;
}

int format_table_binding(Call& call) {
  TableReader reader = call.options(2);
  const report::Table table = table_from_rows(call, call.index(1), reader);
  reader.finish();
  std::string text = report::format_table(table);
  if (text.ends_with('\n')) text.pop_back();  // print adds one
  return call.give(text);
}

std::vector<Parameter> animate_parameters() {
  const report::AnimateOptions usual;
  std::vector<Parameter> parameters = parameters_of(usual);
  parameters.push_back(labels_parameter());
  const std::vector<Parameter> style = style_parameters(usual.style);
  parameters.insert(parameters.end(), style.begin(), style.end());
  return parameters;
}

void describe_film(Api& api) {
  api.add(FunctionEntry{
      .name = "animate",
      .group = kGroup,
      .summary = "Draws levels or runs side by side, synchronized, as frame_0000.png ...",
      .arguments = {{.name = "folder", .type = "string", .help = "folder for the frames"},
                    {.name = "runs",
                     .type = "Comparison, Trajectory or list of either",
                     .help =
                         "results of compare, of which all levels are drawn and the base of the "
                         "first one; or of run, of any bodies and scenarios: a run that ends "
                         "before others keeps its last frame"}},
      .options = animate_parameters(),
      .returns = "integer, number: number of frames, and frame rate at which s.video plays them at "
                 "the right speed [1/s]",
      .errors = "A size beyond the largest picture; a file cannot be written; labels that do not "
                "match in number; a run with no frames but the first and the last.",
      .example = "local frames, rate = s.animate(\"out/frames\", comparison, {frames = 60})\n"
                 "s.animate(\"out/both\", {merged, fitted}, {levels = {0, 2}})\n"
                 "s.animate(\"out/runs\", {soft, hard}, {labels = {\"soft\", \"hard\"}})",
      .call = animate_binding});
  api.add(FunctionEntry{
      .name = "video",
      .group = kGroup,
      .summary =
          "Encodes frames as .mp4 or .gif with ffmpeg; prints the command if ffmpeg is missing.",
      .arguments = {{.name = "path", .type = "string", .help = "NAME.mp4 or NAME.gif to write"},
                    {.name = "folder",
                     .type = "string",
                     .help = "folder with the frames of animate"}},
      .options = {{.name = "frame_rate",
                   .type = "number",
                   .range = Range{0.01, 1000},
                   .fallback = fmt::format("{}", report::kUsualFrameRate),
                   .help = "frames per second"}},
      .returns = "boolean, string: whether the video was made, and the command that makes it",
      .errors = "ffmpeg fails; another ending than .mp4 or .gif.",
      .example = "local frames, rate = s.animate(\"out/frames\", comparison, {frames = 60})\n"
                 "s.video(\"out/comparison.mp4\", \"out/frames\", {frame_rate = rate})",
      .call = video_binding});
}

void describe_tables(Api& api) {
  const Parameter rows{.name = "rows",
                       .type = "list of tables",
                       .help = "rows: lists of cells, or tables with the columns as keys"};
  const std::vector<Parameter> options{
      {.name = "columns",
       .type = "list of strings",
       .fallback = "the keys of the first row, sorted",
       .help = "names of the columns, in order; needed if rows are lists"}};
  api.add(FunctionEntry{
      .name = "csv",
      .group = kGroup,
      .summary = "Writes rows as a CSV file.",
      .arguments = {{.name = "path", .type = "string", .help = "file to write"}, rows},
      .options = options,
      .returns = "nothing",
      .errors = "Rows of different lengths; the file cannot be written.",
      .example = "local rows, columns = runs:table()\n"
                 "s.csv(\"out/table.csv\", rows, {columns = columns})",
      .call = csv_binding});
  api.add(FunctionEntry{
      .name = "format_table",
      .group = kGroup,
      .summary =
          "Formats rows as a text table for a terminal, at most 100 columns wide if its words "
          "allow it. Numbers have four digits.",
      .arguments = {rows},
      .options = options,
      .returns = "string",
      .errors = "Rows of different lengths.",
      .example = "print(s.format_table(rows, {columns = {\"label\", \"nodes\"}}))",
      .call = format_table_binding});
}

}  // namespace

void describe_report(Api& api) {
  describe_film(api);
  describe_series(api);
  api.add(FunctionEntry{
      .name = "chart",
      .group = kGroup,
      .summary = "Draws a chart as .svg or .png: cost against error of a comparison, runs over "
                 "time, a stability map, or any series.",
      .arguments = {{.name = "path", .type = "string", .help = "NAME.svg or NAME.png to write"},
                    {.name = "data",
                     .type = "Comparison, Trajectory, list of either, StabilityMap or list of "
                             "Series",
                     .help = "data to draw: one point per level of a comparison, one series per "
                             "comparison of a list, one line per run, or one panel per level and "
                             "integrator of a map (which uses only the option title)"}},
      .options = chart_parameters(),
      .returns = "boolean, string: whether the chart was drawn (gnuplot may be missing), the "
                 "command that draws it",
      .errors = "No points; another ending than .svg or .png; labels that do not match in number; "
                "a run with fewer than three frames, or without a ledger for its energies.",
      .example = "s.chart(\"out/cost-error.svg\", comparison)\n"
                 "s.chart(\"out/height.svg\", {soft, hard}, {labels = {\"soft\", \"hard\"}})\n"
                 "s.chart(\"out/line.svg\", {{name = \"y = x^2\", points = {{1, 1}, {2, 4}}}})",
      .call = chart_binding});
  describe_tables(api);
  describe_view(api);
}

}  // namespace springlod::scripting
