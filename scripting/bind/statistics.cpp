// Samples of numbers: statistics, distances between samples, and the noise floor.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "report/stats.hpp"
#include "scripting/bind/tables/options.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Statistics";
/// The row of BootstrapOptions that statistics of one sample leave out.
constexpr std::string_view kNeedsTwoSamples = "paired";

using Lists = std::vector<std::vector<double>>;

/// The numbers of the list at `index`; `name` names it in messages.
std::vector<double> numbers_at(lua_State* L, int index, const std::string& name) {
  std::vector<double> numbers;
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= count; ++i) {
    if (lua_rawgeti(L, index, i) != LUA_TNUMBER)
      throw InputError(fmt::format("{}[{}] must be a number, not {}", name, i,
                                   describe_type_at(L, lua_gettop(L))));
    numbers.push_back(lua_tonumber(L, -1));
    lua_pop(L, 1);
  }
  return numbers;
}

/// {1, 2, ...} as one list, {{1, 2}, {3, 4}, ...} as several.
Lists lists_at(Call& call, int argument, const std::string& name, bool& several) {
  lua_State* L = call.lua();
  const int index = call.has(argument) ? call.index(argument) : 0;
  if (index == 0 || !lua_istable(L, index)) call.refuse(argument, "a list of numbers, or of lists");
  several = lua_rawgeti(L, index, 1) == LUA_TTABLE;
  lua_pop(L, 1);
  if (!several) return {numbers_at(L, index, name)};
  Lists lists;
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= count; ++i) {
    const std::string item = fmt::format("{}[{}]", name, i);
    if (lua_rawgeti(L, index, i) != LUA_TTABLE)
      throw InputError(fmt::format("{} must be a list as {}[1] is", item, name));
    lists.push_back(numbers_at(L, lua_gettop(L), item));
    lua_pop(L, 1);
  }
  return lists;
}

/// A list with one number for each start, or with one list for each start that has one number for
/// each seed.
report::StartSample sample_argument(Call& call, int argument, const std::string& name) {
  bool by_seeds = false;
  Lists lists = lists_at(call, argument, name, by_seeds);
  if (!by_seeds) return {std::move(lists[0])};
  if (lists[0].empty())
    throw InputError(name + "[1] is empty; give every start one value per seed");
  report::StartSample sample{{}, static_cast<std::uint32_t>(lists[0].size())};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    if (lists[i].size() != lists[0].size())
      throw InputError(fmt::format(
          "{0}[{1}] and {0}[1] differ in length, {2} and {3}; give every start one value per seed",
          name, i + 1, lists[i].size(), lists[0].size()));
    sample.values.insert(sample.values.end(), lists[i].begin(), lists[i].end());
  }
  return sample;
}

int mean_binding(Call& call) {
  return call.give(report::mean(sample_argument(call, 1, "sample").values));
}

int statistics_binding(Call& call) {
  const report::StartSample sample = sample_argument(call, 1, "sample");
  report::SampleComparisonOptions options;
  report::BootstrapOptions& resampling = options.resampling;
  resampling.seed = call.session().settings().seed;
  TableReader reader = call.options(2);
  reader.read("confidence", options.confidence);
  read_options(call, reader, resampling, nullptr, kNeedsTwoSamples);
  reader.finish();
  resampling.progress = call.progress();
  const report::Interval of_mean =
      report::interval(report::bootstrap(sample, report::mean, resampling), options.confidence);
  const report::Interval of_deviation = report::interval(
      report::bootstrap(sample, report::standard_deviation, resampling), options.confidence);
  lua_State* L = call.lua();
  begin_table(L);
  set_field(L, "count", sample.values.size());
  set_field(L, "mean", report::mean(sample.values));
  set_field(L, "mean_low", of_mean.low);
  set_field(L, "mean_high", of_mean.high);
  set_field(L, "deviation", report::standard_deviation(sample.values));
  set_field(L, "deviation_low", of_deviation.low);
  set_field(L, "deviation_high", of_deviation.high);
  set_field(L, "minimum", report::quantile(sample.values, 0));
  set_field(L, "lower_quartile", report::quantile(sample.values, 0.25));
  set_field(L, "median", report::quantile(sample.values, 0.5));
  set_field(L, "upper_quartile", report::quantile(sample.values, 0.75));
  set_field(L, "maximum", report::quantile(sample.values, 1));
  return 1;
}

void push_measured(lua_State* L, const char* name, const report::Measured& measured) {
  begin_table(L);
  set_field(L, "value", measured.value);
  set_field(L, "low", measured.interval.low);
  set_field(L, "high", measured.interval.high);
  end_field(L, name);
}

int compare_samples_binding(Call& call) {
  const report::StartSample base = sample_argument(call, 1, "base");
  const report::StartSample other = sample_argument(call, 2, "other");
  report::SampleComparisonOptions options;
  options.resampling.seed = call.session().settings().seed;
  TableReader reader = call.options(3);
  read_options(call, reader, options);
  reader.finish();
  options.resampling.progress = call.progress();
  const report::SampleComparison result = report::compare_samples(base, other, options);
  lua_State* L = call.lua();
  begin_table(L);
  push_measured(L, "difference", result.difference);
  push_measured(L, "difference_over_spread", result.difference_over_spread);
  push_measured(L, "wasserstein", result.wasserstein);
  push_measured(L, "energy_distance", result.energy);
  if (result.equivalence) {
    set_field(L, "equivalent", result.equivalence->equivalent);
    set_field(L, "p", result.equivalence->p());
    set_field(L, "p_lower", result.equivalence->p_lower);
    set_field(L, "p_higher", result.equivalence->p_higher);
  }
  return 1;
}

int noise_floor_binding(Call& call) {
  bool several = false;
  const Lists sources = lists_at(call, 1, "sources", several);
  report::NoiseFloorOptions options;
  options.seed = call.session().settings().seed;
  TableReader reader = call.options(2);
  read_options(call, reader, options);
  reader.finish();
  options.progress = call.progress();
  return call.give(std::shared_ptr<const report::NoiseFloor>(
      std::make_shared<report::NoiseFloor>(report::noise_floor(sources, options))));
}

int judge_method(Call& call) {
  const auto floor = call.self<report::NoiseFloor>();
  const report::StartSample base = sample_argument(call, 1, "base");
  const report::FloorVerdict verdict =
      report::inside_noise_floor(*floor, base.values, sample_argument(call, 2, "other").values);
  lua_State* L = call.lua();
  begin_table(L);
  set_field(L, "inside", verdict.inside);
  set_field(L, "distance", verdict.distance);
  set_field(L, "p", verdict.p);
  return 1;
}

Parameter sample_parameter(const char* name, const char* help) {
  return {
      .name = name,
      .type = "list of numbers",
      .help = std::string(help) +
              "; with several simplification seeds, one list per start with one number per seed"};
}

/// The options that statistics_binding reads.
std::vector<Parameter> statistics_parameters() {
  std::vector<Parameter> compared = parameters_of<report::SampleComparisonOptions>();
  std::vector<Parameter> parameters = session_parameters<report::BootstrapOptions>();
  std::erase_if(parameters,
                [](const Parameter& parameter) { return parameter.name == kNeedsTwoSamples; });
  parameters.insert(parameters.begin(), find_parameter(compared, "confidence"));
  return parameters;
}

void describe_samples(Api& api) {
  api.add(FunctionEntry{
      .name = "mean",
      .group = kGroup,
      .summary =
          "Mean of a list of numbers. For five values or more, s.statistics adds an interval.",
      .arguments = {{.name = "sample", .type = "list of numbers", .help = "at least one number"}},
      .returns = "number",
      .errors = "An empty list; a value that is not finite.",
      .example = "print(s.mean{7.1, 8.4, 6.9})",
      .call = mean_binding});
  api.add(FunctionEntry{
      .name = "statistics",
      .group = kGroup,
      .summary = "Mean, spread and quartiles of a sample, with intervals.",
      .arguments = {sample_parameter("sample", "one value per start")},
      .options = statistics_parameters(),
      .returns = "table: count, mean, mean_low, mean_high, deviation, deviation_low, "
                 "deviation_high, minimum, lower_quartile, median, upper_quartile, maximum",
      .errors = "Fewer than 5 starts; a value that is not finite.",
      .example = "local m = s.statistics({7.1, 8.4, 6.9, 9.2, 7.7, 8.0})\n"
                 "print(m.mean, m.mean_low, m.mean_high)",
      .call = statistics_binding});
  api.add(FunctionEntry{
      .name = "compare_samples",
      .group = kGroup,
      .summary =
          "Distances between two samples, and an equivalence test of their means with a margin.",
      .arguments = {sample_parameter("base", "one value per start"),
                    sample_parameter(
                        "other",
                        "sample to compare with base; may have another size unless paired")},
      .options = session_parameters<report::SampleComparisonOptions>(),
      .returns = "table: difference (of the means, other minus base), difference_over_spread (in "
                 "standard deviations of the base), wasserstein and energy_distance (without a "
                 "root), each a table {value, low, high}; with a margin equivalent (boolean), p, "
                 "p_lower and p_higher (against \"lower by the margin or more\", \"higher ...\")",
      .errors = "Fewer than 5 starts; pairs of different length; a base without spread; a value "
                "that is not finite.",
      .example = "local c = s.compare_samples(base, level, {paired = true, margin = 0.5})\n"
                 "print(c.difference.value, c.difference.low, c.difference.high, c.equivalent)",
      .call = compare_samples_binding});
}

void describe_noise_floor(Api& api) {
  TypeBuilder<report::NoiseFloor> type(
      "Distances between samples of the base.", [](const report::NoiseFloor& floor) {
        return fmt::format(
            "NoiseFloor: {} distance {:.4g} ({:.4g} % of {} distances, {} against "
            "{} values{})",
            to_string(floor.distance), floor.level, 100 * floor.part, floor.distances.size(),
            floor.base_size, floor.other_size,
            floor.with_replacement ? ", drawn with replacement" : "");
      });
  type.field("level", "number",
             "noise floor: this `quantile` of the distances between samples of the base",
             [](const report::NoiseFloor& floor) { return floor.level; });
  type.field("distance", "string", "\"wasserstein\" or \"energy\"",
             [](const report::NoiseFloor& floor) { return to_string(floor.distance); });
  type.field("quantile", "number", "fraction of the distances below the level",
             [](const report::NoiseFloor& floor) { return floor.part; });
  type.field("size", "integer", "size of the base's sample",
             [](const report::NoiseFloor& floor) { return floor.base_size; });
  type.field("other_size", "integer", "size of the other sample",
             [](const report::NoiseFloor& floor) { return floor.other_size; });
  type.field("distances", "list of numbers", "all distances, ascending",
             [](const report::NoiseFloor& floor) { return floor.distances; });
  type.field("with_replacement", "boolean",
             "whether the only source was too small to draw without replacement",
             [](const report::NoiseFloor& floor) { return floor.with_replacement; });
  type.method({.name = "judge",
               .summary = "Tests whether the distance of two samples is within the noise floor.",
               .arguments = {{.name = "base",
                              .type = "list of numbers",
                              .help = "sample with the size of the floor"},
                             {.name = "other",
                              .type = "list of numbers",
                              .help = "sample with the other_size of the floor"}},
               .returns = "table: inside (boolean), distance, p (fraction of distances between "
                          "samples of the base that are at least as large)",
               .errors = "Samples of other sizes than the floor's.",
               .call = judge_method});
  api.add(type.build());
  api.add(FunctionEntry{
      .name = "noise_floor",
      .group = kGroup,
      .summary = "Noise floor: distances between samples of the base, for comparison with a "
                 "level's distance.",
      .arguments = {{.name = "sources",
                     .type = "list of numbers",
                     .help = "a large sample of the base, or a list of samples: other starts, half "
                             "the step, another integrator"}},
      .options = session_parameters<report::NoiseFloorOptions>(),
      .returns = "NoiseFloor",
      .errors = "Samples that are smaller than size; fewer than 7 samples of exactly that size.",
      .example = "local floor = s.noise_floor(base_of_many_starts, {size = 24})\n"
                 "print(floor, floor:judge(base, level).inside)",
      .call = noise_floor_binding});
}

}  // namespace

void describe_statistics(Api& api) {
  describe_samples(api);
  describe_noise_floor(api);
}

}  // namespace springlod::scripting
