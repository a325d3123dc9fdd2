#include "report/pick_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/units.hpp"
#include "report/no_contact_text.hpp"

namespace springlod::report {
namespace {

using sim::Pick;
using sim::PickLevel;

constexpr double kPercent = 100;

// Two digits, so that a prediction does not look more accurate than it is.
std::string percent(double fraction) {
  const double value = kPercent * fraction;
  if (value >= 10) return fmt::format("{:.0f} %", value);
  return fmt::format("{:.2g} %", value);
}

std::string seconds(double time) {
  if (!(time > 0)) return "0 s";
  const double digit = std::pow(10, std::floor(std::log10(time)) - 1);
  return format_quantity(std::round(time / digit) * digit, Dimension::time);
}

std::string ratio(double times) {
  return times >= 10 ? fmt::format("{:.0f}", times) : fmt::format("{:.1f}", times);
}

/// Words that depend on how the errors were found.
struct Words {
  const char* error;     // "predicted error"
  const char* an_error;  // "a predicted error"
};
Words words_of(const Pick& pick) {
  return pick.options.measure ? Words{"measured error", "a measured error"}
                              : Words{"predicted error", "a predicted error"};
}

std::string error_text(const Pick& pick, const PickLevel& level) {
  if (level.level == 0) return "it is the reference of all errors";
  if (!std::isfinite(level.error)) return "without springs, its error cannot be predicted";
  return fmt::format("{} {}", words_of(pick).error, percent(level.error));
}

std::string name(const Pick& pick, const PickLevel& level) {
  if (level.level == 0) return fmt::format("The base ({} nodes)", level.nodes);
  return fmt::format("Level {} ({} of the nodes)", level.level,
                     percent(static_cast<double>(level.nodes) / pick.levels.front().nodes));
}

/// "14 times cheaper than the base (0.21 ms instead of 2.9 ms a frame)"
std::string gain(const PickLevel& base, const PickLevel& level) {
  constexpr double kCheaper = 1.1;  // less is within the accuracy of measured times
  const double times = base.cost / level.cost;
  if (times >= kCheaper)
    return fmt::format("{} times cheaper than the base ({} instead of {} a frame)", ratio(times),
                       seconds(level.cost), seconds(base.cost));
  if (times <= 1 / kCheaper)
    return fmt::format("{} times as costly as the base ({} instead of {} a frame)",
                       ratio(1 / times), seconds(level.cost), seconds(base.cost));
  return fmt::format("about as costly as the base ({} against {} a frame)", seconds(level.cost),
                     seconds(base.cost));
}

std::string would_be(const Pick& pick, const PickLevel& level) {
  if (!std::isfinite(level.error) || level.faulty) return "";
  return fmt::format(" Level {} would be {}, with {} of {}.", level.level,
                     gain(pick.levels.front(), level), words_of(pick).an_error,
                     percent(level.error));
}

std::string within_error(const Pick& pick) {
  const PickLevel& base = pick.levels.front();
  const PickLevel& picked = pick.levels[*pick.level];
  const std::string wanted = percent(*pick.options.error);
  if (picked.level == 0)
    return fmt::format("Only the base ({} nodes, {} a frame) stays within {}.", base.nodes,
                       seconds(base.cost), wanted) +
           would_be(pick, pick.levels[1]);
  std::string text = fmt::format("{} stays within {}: {}, {}.", name(pick, picked), wanted,
                                 error_text(pick, picked), gain(base, picked));
  if (picked.level + 1 < pick.levels.size())
    return text + would_be(pick, pick.levels[*pick.level + 1]);
  return text + " It is the coarsest level.";
}

std::string within_budget(const Pick& pick) {
  const PickLevel& base = pick.levels.front();
  const std::string wanted = seconds(*pick.options.budget);
  if (!pick.level) {
    const PickLevel& cheapest =
        *std::min_element(pick.levels.begin(), pick.levels.end(),
                          [](const PickLevel& p, const PickLevel& q) { return p.cost < q.cost; });
    return fmt::format(
        "No level stays within {} a frame. The cheapest is level {}: {} a frame, {}. Build coarser "
        "levels, or allow more time.",
        wanted, cheapest.level, seconds(cheapest.cost), error_text(pick, cheapest));
  }
  const PickLevel& picked = pick.levels[*pick.level];
  if (picked.level == 0)
    return fmt::format(
               "The base ({} nodes) stays within {}: {} a frame. No coarser level is "
               "needed.",
               base.nodes, wanted, seconds(base.cost)) +
           would_be(pick, pick.levels[1]);
  return fmt::format("{} is the most accurate within {} a frame: {}, {}.", name(pick, picked),
                     wanted, error_text(pick, picked), gain(base, picked)) +
         (picked.level > 1 ? would_be(pick, pick.levels[*pick.level - 1]) : "");
}

}  // namespace

std::string pick_text(const sim::Pick& pick) {
  std::string text = pick.options.error ? within_error(pick) : within_budget(pick);
  for (const PickLevel& level : pick.levels)
    if (level.faulty)
      text += fmt::format(
          " Level {} is faulty, so it is not picked: springlod info says why; make it anew with "
          "more nodes (keep) or smaller cells.",
          level.level);
  if (pick.no_contact) text += "\nwarning: " + no_contact_text(*pick.no_contact);
  return text;
}

Table pick_table(const sim::Pick& pick) {
  Table table;
  table.columns = {"level",      "nodes", "springs",       "cost",
                   "cost_ratio", "error", "error_percent", "within"};
  const double base = pick.levels.front().cost;
  for (const PickLevel& level : pick.levels) {
    const bool known = std::isfinite(level.error);
    table.rows.push_back({whole(level.level), whole(level.nodes), whole(level.springs), level.cost,
                          base / level.cost, known ? Cell(level.error) : Cell(),
                          known ? Cell(kPercent * level.error) : Cell(),
                          whole(level.within ? 1 : 0)});
  }
  return table;
}

std::string pick_columns_help() {
  return "level, nodes, springs, cost (processor time for a frame [s]), cost_ratio (base / level), "
         "error and error_percent (of the base's bounding diagonal; empty for a level without "
         "springs), within (1 if the level satisfies the request, else 0)";
}

}  // namespace springlod::report
