#include "scripting/bind/tables/labelled_runs.hpp"

#include <cstdint>
#include <set>

#include <fmt/format.h>

#include "base/message.hpp"
#include "sim/study/compare.hpp"

namespace springlod::scripting {

namespace {

/// The names of the levels, if all runs are of different levels of one chain.
std::vector<std::string> usual_labels(const RunValues& runs) {
  std::set<std::uint32_t> levels;
  std::vector<std::string> names;
  std::vector<std::string> numbers;
  for (const auto& run : runs) {
    const std::uint32_t level = run->model->level;
    if (run->model->chain && run->model->chain == runs.front()->model->chain) levels.insert(level);
    names.push_back(sim::level_label(level));
    numbers.push_back(fmt::format("run {}", names.size()));
  }
  return levels.size() == runs.size() ? names : numbers;
}

std::vector<std::string> labels_of(const RunValues& runs, TableReader& reader) {
  if (!reader.has("labels")) return usual_labels(runs);
  std::vector<std::string> labels;
  reader.read("labels", labels);
  if (labels.size() != runs.size())
    reader.refuse("labels", fmt::format("a list with one label for each run: {} labels for {}",
                                        labels.size(), counted(runs.size(), "run")));
  for (const std::string& label : labels)
    if (label.find('\n') != std::string::npos) reader.refuse("labels", "texts of one line each");
  return labels;
}

}  // namespace

std::vector<report::LabelledRun> labelled_runs(const RunValues& runs, TableReader& reader) {
  const std::vector<std::string> labels = labels_of(runs, reader);
  std::vector<report::LabelledRun> labelled;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const ModelValue& model = *runs[i]->model;
    labelled.push_back({labels[i], *model.model, runs[i]->trajectory, *runs[i]->scenario});
    if (!model.surface || !model.surface_of_base) continue;
    labelled.back().surface = model.surface.get();
    labelled.back().surface_of_nodes = surface_binding(model);
  }
  return labelled;
}

void refuse_labels(TableReader& reader, const std::string& instead) {
  if (reader.has("labels")) reader.refuse("labels", "given for Trajectories only; " + instead);
}

Parameter labels_parameter() {
  return {.name = "labels",
          .type = "list of strings",
          .range = Range{0, kLongestTitle},
          .fallback = "\"base\", \"level 1\", ... for levels of one chain, else \"run 1\", ...",
          .help = "names of the Trajectories, one for each"};
}

}  // namespace springlod::scripting
