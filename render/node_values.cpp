#include "render/node_values.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/moduli.hpp"
#include "render/value_colour.hpp"

namespace springlod::render {
namespace {

using Range = std::pair<double, double>;

// Ratio of largest to smallest value above which the scale is logarithmic.
constexpr double kWideSpan = 100;
// Values that differ only by rounding count as equal.
constexpr double kRounding = 1e-9;

struct ShownUnit {
  double in_si;
  const char* name;
};

// The largest unit in which the number is at least 1, else the smallest unit.
ShownUnit fitting(const std::vector<ShownUnit>& units, double value) {
  ShownUnit best = units.front();
  for (const ShownUnit& unit : units)
    if (std::abs(value) >= unit.in_si * (1 - kRounding)) best = unit;
  return best;
}

std::vector<double> values_of(const DrawnBody& body) {
  if (body.node_values != nullptr) return *body.node_values;
  switch (body.style.node_colour) {
    case NodeColour::young:
      return elastic::estimate(*body.model).young;
    case NodeColour::density:
      return elastic::estimate(*body.model).density;
    case NodeColour::mass:
      return body.model->mass;
    case NodeColour::material:
      break;
  }
  return {};
}

void name_scale(ValueScale& scale, const DrawnBody& body) {
  ShownUnit unit{1, ""};
  std::string name = "value";
  if (body.node_values == nullptr) {
    switch (body.style.node_colour) {
      case NodeColour::young:
        name = "Young's modulus";
        unit = fitting({{1, "Pa"}, {1e3, "kPa"}, {1e6, "MPa"}, {1e9, "GPa"}}, scale.high);
        break;
      case NodeColour::density:
        name = "density";
        unit = {1, "kg/m\u00b3"};
        break;
      case NodeColour::mass:
        name = "mass";
        unit = fitting({{1e-6, "mg"}, {1e-3, "g"}, {1, "kg"}}, scale.high);
        break;
      case NodeColour::material:
        break;
    }
  }
  if (!body.style.values.label.empty()) name = body.style.values.label;
  scale.unit = unit.in_si;
  scale.label = *unit.name != '\0' ? fmt::format("{} ({})", name, unit.name) : name;
}

void require_usable(const DrawnBody& body, const std::vector<double>& values) {
  if (values.size() != body.model->rest.size())
    throw InputError(
        fmt::format("drawing: {} node values for a model of {} nodes; give one per node",
                    values.size(), body.model->rest.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw InputError(
          fmt::format("drawing: the value of node {} is not a finite number", script_number(i)));
  const auto& range = body.style.values.range;
  if (range && !(range->first < range->second))
    throw InputError(fmt::format("drawing: the range of values must be increasing, got {} to {}",
                                 range->first, range->second));
}

bool is_logarithmic(const ValueScale& scale, ValueScaling scaling) {
  if (scaling == ValueScaling::linear) return false;
  if (scaling == ValueScaling::logarithmic && !(scale.low > 0))
    throw InputError(fmt::format(
        "drawing: a logarithmic scale needs values above 0, but the smallest is {}; set a range "
        "that starts above 0, or a linear scale",
        scale.low));
  return scaling == ValueScaling::logarithmic ||
         (scale.low > 0 && scale.high > kWideSpan * scale.low);
}

// Bodies with one key share a scale.
std::string key_of(const DrawnBody& body) {
  return body.node_values != nullptr ? "own values " + body.style.values.label
                                     : fmt::format("{}", static_cast<int>(body.style.node_colour));
}

}  // namespace

double ValueScale::part(double value) const {
  if (!(high > low)) return 0.5;
  const double t = logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low)
                               : (value - low) / (high - low);
  return std::clamp(t, 0., 1.);
}

double ValueScale::value(double part) const {
  return logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
}

bool shows_values(const DrawnBody& body) {
  return body.model != nullptr &&
         (body.node_values != nullptr || body.style.node_colour != NodeColour::material);
}

std::vector<std::optional<ValueScale>> colour_by_values(std::vector<Panel>& panels) {
  std::map<std::string, Range> common;
  std::vector<std::vector<double>> all_values;  // of the bodies that show values, in order
  for (const Panel& panel : panels)
    for (const DrawnBody& body : panel.bodies) {
      if (!shows_values(body)) continue;
      const std::vector<double>& values = all_values.emplace_back(values_of(body));
      require_usable(body, values);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      if (low == values.end()) continue;
      Range& range = common.try_emplace(key_of(body), *low, *high).first->second;
      range = {std::min(range.first, *low), std::max(range.second, *high)};
    }

  std::vector<std::optional<ValueScale>> scales(panels.size());
  auto values = all_values.begin();
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (DrawnBody& body : panels[p].bodies) {
      if (!shows_values(body)) continue;
      const ValueStyle& style = body.style.values;
      ValueScale scale;
      std::tie(scale.low, scale.high) = style.range ? *style.range : common[key_of(body)];
      if (scale.high - scale.low <= kRounding * std::abs(scale.high)) scale.low = scale.high;
      scale.logarithmic = is_logarithmic(scale, style.scaling);
      name_scale(scale, body);
      body.node_colours.clear();
      for (const double value : *values)
        body.node_colours.push_back(value_colour(scale.part(value)));
      ++values;
      scales[p] = scale;
    }
  return scales;
}

}  // namespace springlod::render
