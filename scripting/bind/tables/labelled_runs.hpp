#pragma once

#include <memory>
#include <string>
#include <vector>

#include "report/labelled_run.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

using RunValues = std::vector<std::shared_ptr<const TrajectoryValue>>;

/// The runs with the option `labels`. By default, different levels of one chain have the names of
/// the levels, and other runs have numbers. Throws InputError for labels that do not match in
/// number. The result refers to `runs`.
std::vector<report::LabelledRun> labelled_runs(const RunValues& runs, TableReader& reader);

/// For other values than runs: throws InputError if the script gives the option `labels`, with
/// `instead`: what names those values.
void refuse_labels(TableReader& reader, const std::string& instead);

Parameter labels_parameter();

}  // namespace springlod::scripting
