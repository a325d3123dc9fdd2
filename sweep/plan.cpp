#include "sweep/plan.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"

namespace springlod::sweep {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int kFormat = 1;

ordered_json files_json(const Plan& plan) {
  ordered_json files = ordered_json::array();
  for (const SourceFile& file : plan.files)
    files.push_back({{"path", file.path}, {"hash", file.hash}});
  return files;
}

ordered_json stages_json(const Plan& plan) {
  ordered_json stages = ordered_json::array();
  for (const Stage& stage : plan.stages)
    stages.push_back({{"name", stage.name},
                      {"units", stage.units},
                      {"columns", stage.columns},
                      {"waits", stage.waits},
                      {"alone", stage.alone}});
  return stages;
}

ordered_json to_json(const Plan& plan) {
  ordered_json costs = ordered_json::array();
  for (const CostRun& run : plan.costs) costs.push_back({run.units, run.cost});
  return {{"format", kFormat},
          {"springlod", plan.version},
          {"program", plan.program},
          {"script", plan.script},
          {"arguments", plan.arguments},
          {"folder", plan.folder},
          {"seed", plan.seed},
          {"sandbox", plan.sandbox},
          {"portable", plan.portable},
          {"files", files_json(plan)},
          {"stages", stages_json(plan)},
          {"units", plan.unit_count()},
          {"seconds_per_cost", plan.seconds_per_cost},
          {"costs", costs},
          {"tasks", plan.tasks}};
}

void read_lists(const ordered_json& json, Plan& plan) {
  for (const ordered_json& file : json.at("files"))
    plan.files.push_back({file.at("path"), file.at("hash")});
  for (const ordered_json& stage : json.at("stages"))
    plan.stages.push_back({stage.at("name"), stage.at("units"), stage.at("columns"),
                           stage.at("waits"), stage.at("alone")});
  for (const ordered_json& run : json.at("costs"))
    plan.costs.push_back({run.at(0).get<std::uint64_t>(), run.at(1).get<double>()});
  json.at("tasks").get_to(plan.tasks);
}

/// Whether tasks begin with unit 0 and ascend, and costs are those of all units.
bool is_whole(const Plan& plan) {
  std::uint64_t costs = 0;
  for (const CostRun& run : plan.costs) costs += run.units;
  const auto not_above = [](std::uint64_t a, std::uint64_t b) { return a >= b; };
  return !plan.stages.empty() && !plan.tasks.empty() && plan.tasks.front() == 0 &&
         std::adjacent_find(plan.tasks.begin(), plan.tasks.end(), not_above) == plan.tasks.end() &&
         plan.tasks.back() < plan.unit_count() && costs == plan.unit_count();
}

Plan from_json(const ordered_json& json) {
  Plan plan;
  plan.version = json.at("springlod");
  plan.program = json.at("program");
  plan.script = json.at("script");
  json.at("arguments").get_to(plan.arguments);
  plan.folder = json.at("folder");
  plan.seed = json.at("seed");
  plan.sandbox = json.at("sandbox");
  plan.portable = json.value("portable", false);
  plan.seconds_per_cost = json.at("seconds_per_cost");
  read_lists(json, plan);
  return plan;
}

std::string words_of(const std::vector<std::string>& arguments) {
  return arguments.empty()
             ? "none"
             : shell_line(arguments.front(), {arguments.begin() + 1, arguments.end()});
}

/// The first file whose content differs, or that only one of the plans was made with; empty: none.
std::string changed_file(const Plan& kept, const Plan& plan) {
  for (std::size_t i = 0; i < std::max(kept.files.size(), plan.files.size()); ++i) {
    if (i >= kept.files.size()) return plan.files[i].path;
    if (i >= plan.files.size() || kept.files[i].path != plan.files[i].path ||
        kept.files[i].hash != plan.files[i].hash)
      return kept.files[i].path;
  }
  return "";
}

/// Of what the results of the plan `kept` are that are no results of `plan`.
std::string difference(const Plan& kept, const Plan& plan) {
  if (kept.script != plan.script) return fmt::format("the script {}", kept.script);
  if (kept.arguments != plan.arguments)
    return fmt::format("the arguments {}", words_of(kept.arguments));
  if (kept.portable != plan.portable)
    return fmt::format("a plan {} --portable", kept.portable ? "with" : "without");
  if (kept.seed != plan.seed) return fmt::format("the seed {}", kept.seed);
  if (kept.version != plan.version || kept.program != plan.program)
    return "another version of the program or its scripts";
  if (const std::string file = changed_file(kept, plan); !file.empty())
    return fmt::format("another content of {}", file);
  return "other units";
}

fs::path hash_path(const fs::path& folder) {
  return folder / "plan.hash";
}

}  // namespace

std::uint64_t Plan::unit_count() const {
  std::uint64_t count = 0;
  for (const Stage& stage : stages) count += stage.units;
  return count;
}

double Plan::total_cost() const {
  double sum = 0;
  for (const CostRun& run : costs) sum += static_cast<double>(run.units) * run.cost;
  return sum;
}

std::size_t Plan::stage_of(std::uint64_t unit) const {
  std::size_t stage = 0;
  while (stage + 1 < stages.size() && unit >= stages[stage].units) unit -= stages[stage++].units;
  return stage;
}

std::uint64_t Plan::first_unit(std::size_t stage) const {
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < stage; ++i) first += stages[i].units;
  return first;
}

std::vector<Phase> Plan::phases() const {
  std::vector<Phase> all;
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    if (all.empty() || stages[stage].waits) all.push_back({stage, stage, stages[stage].alone});
    all.back().end = stage + 1;
  }
  return all;
}

std::uint64_t Plan::end_of_task(std::size_t task) const {
  return task + 1 < tasks.size() ? tasks[task + 1] : unit_count();
}

void add_cost(std::vector<CostRun>& costs, double cost) {
  if (costs.empty() || costs.back().cost != cost)
    costs.push_back({1, cost});
  else
    ++costs.back().units;
}

fs::path plan_path(const fs::path& folder) {
  return folder / "plan.json";
}

std::string results_hash(const Plan& plan) {
  const ordered_json json{plan.version, plan.program,  plan.script,       plan.arguments,
                          plan.seed,    plan.portable, stages_json(plan), files_json(plan)};
  return content_hash(json.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

void require_own_results(const fs::path& folder, const Plan& plan) {
  std::error_code error;
  if (!fs::exists(folder / "results", error)) return;
  const fs::path hash = hash_path(folder);
  if (fs::exists(hash, error) && read_file(hash) == results_hash(plan) + "\n") return;
  std::string owner = "another plan";
  try {
    owner = difference(read_plan(folder), plan);
  } catch (const Error&) {
    // It is damaged, or there is none.
  }
  throw InputError(fmt::format("{} holds results of {}; choose another folder, or remove this one",
                               folder.string(), owner));
}

void remove_plan(const fs::path& folder) {
  read_plan(folder);  // so that no other folder loses anything
  for (const char* name : {"results", "logs", "jobs"}) fs::remove_all(folder / name);
  fs::remove(hash_path(folder));
  fs::remove(plan_path(folder));
}

void write_plan(const fs::path& folder, const Plan& plan) {
  write_text_file(hash_path(folder), results_hash(plan) + "\n");
  write_text_file(plan_path(folder), to_json(plan).dump(1) + "\n");
}

Plan read_plan(const fs::path& folder) {
  const fs::path path = plan_path(folder);
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw IoError(
        fmt::format("{} holds no plan; 'springlod sweep plan FILE.lua --out {}' makes one",
                    folder.string(), shell_word(folder.string())));
  try {
    const ordered_json json = ordered_json::parse(read_file(path));
    if (const int format = json.at("format"); format > kFormat)
      throw InputError(
          fmt::format("{} is of format {}, which a newer springlod wrote; this one "
                      "reads {}",
                      path.string(), format, kFormat));
    Plan plan = from_json(json);
    if (is_whole(plan)) return plan;
  } catch (const nlohmann::json::exception&) {
    // named below
  }
  throw InputError(
      fmt::format("{} is damaged; make the plan again, with the same --out: results "
                  "that it already has are kept",
                  path.string()));
}

std::vector<SourceFile> hash_files(const std::vector<fs::path>& paths) {
  std::vector<SourceFile> files;
  for (const fs::path& path : paths)
    files.push_back({path.string(), content_hash(read_file(path))});
  return files;
}

void require_unchanged(const Plan& plan, const std::string& version, const std::string& program) {
  constexpr const char* kWhatNow =
      "results would not fit to those of before. Make a new plan in another folder, or restore "
      "what has changed";
  if (plan.version != version)
    throw InputError(fmt::format("the plan was made with springlod {}, this is {}: {}",
                                 plan.version, version, kWhatNow));
  if (plan.program != program)
    throw InputError(
        fmt::format("the program or one of its scripts has changed since the plan was "
                    "made: {}",
                    kWhatNow));
  for (const SourceFile& file : plan.files) {
    std::error_code error;
    if (!fs::exists(file.path, error))
      throw IoError(fmt::format("{} is missing, which the plan was made with", file.path));
    if (content_hash(read_file(file.path)) != file.hash)
      throw InputError(
          fmt::format("{} has changed since the plan was made: {}", file.path, kWhatNow));
  }
}

}  // namespace springlod::sweep
