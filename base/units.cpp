#include "base/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::inline base {
namespace {

struct Unit {
  std::string_view name;
  double in_si;
};

// The SI unit is the first entry.
constexpr std::array kLength{Unit{"m", 1},     Unit{"nm", 1e-9},   Unit{"um", 1e-6},
                             Unit{"mm", 1e-3}, Unit{"cm", 1e-2},   Unit{"dm", 1e-1},
                             Unit{"km", 1e3},  Unit{"in", 0.0254}, Unit{"ft", 0.3048}};
constexpr std::array kTime{Unit{"s", 1}, Unit{"us", 1e-6}, Unit{"ms", 1e-3}, Unit{"min", 60}};
constexpr std::array kMass{Unit{"kg", 1}, Unit{"mg", 1e-6}, Unit{"g", 1e-3}, Unit{"t", 1e3}};
constexpr std::array kPressure{Unit{"Pa", 1}, Unit{"kPa", 1e3}, Unit{"MPa", 1e6}, Unit{"GPa", 1e9}};
constexpr std::array kDensity{Unit{"kg/m3", 1}, Unit{"kg/m^3", 1}, Unit{"g/cm3", 1e3},
                              Unit{"g/cm^3", 1e3}};
constexpr std::array kVelocity{Unit{"m/s", 1}, Unit{"cm/s", 1e-2}, Unit{"mm/s", 1e-3},
                               Unit{"km/h", 1 / 3.6}};
constexpr std::array kAcceleration{Unit{"m/s2", 1}, Unit{"m/s^2", 1}};
constexpr std::array kAngle{Unit{"rad", 1}, Unit{"deg", std::numbers::pi / 180}};
constexpr std::array kAngularVelocity{Unit{"rad/s", 1}, Unit{"deg/s", std::numbers::pi / 180},
                                      Unit{"rpm", std::numbers::pi / 30}};

std::span<const Unit> units_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::number:
      return {};
    case Dimension::length:
      return kLength;
    case Dimension::time:
      return kTime;
    case Dimension::mass:
      return kMass;
    case Dimension::pressure:
      return kPressure;
    case Dimension::density:
      return kDensity;
    case Dimension::velocity:
      return kVelocity;
    case Dimension::acceleration:
      return kAcceleration;
    case Dimension::angle:
      return kAngle;
    case Dimension::angular_velocity:
      return kAngularVelocity;
  }
  return {};
}

/// Units that format_quantity may use, in ascending order.
std::span<const Unit> display_units(Dimension dimension) {
  static constexpr std::array kShownLength{Unit{"nm", 1e-9}, Unit{"um", 1e-6}, Unit{"mm", 1e-3},
                                           Unit{"m", 1}, Unit{"km", 1e3}};
  static constexpr std::array kShownTime{Unit{"us", 1e-6}, Unit{"ms", 1e-3}, Unit{"s", 1}};
  static constexpr std::array kShownMass{Unit{"mg", 1e-6}, Unit{"g", 1e-3}, Unit{"kg", 1},
                                         Unit{"t", 1e3}};
  switch (dimension) {
    case Dimension::length:
      return kShownLength;
    case Dimension::time:
      return kShownTime;
    case Dimension::mass:
      return kShownMass;
    case Dimension::pressure:
      return kPressure;
    default:
      return units_of(dimension).subspan(0, dimension == Dimension::number ? 0 : 1);
  }
}

std::string names(std::span<const Unit> units) {
  std::string list;
  for (const Unit& unit : units) list += fmt::format("{}{}", list.empty() ? "" : ", ", unit.name);
  return list;
}

std::string_view trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

const Unit* find_unit(std::span<const Unit> units, std::string_view name) {
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.name == name; });
  return found == units.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> unit_names(Dimension dimension) {
  std::vector<std::string> found;
  for (const Unit& unit : units_of(dimension)) found.emplace_back(unit.name);
  return found;
}

std::string_view si_unit(Dimension dimension) {
  const auto units = units_of(dimension);
  return units.empty() ? std::string_view{} : units.front().name;
}

double parse_quantity(std::string_view text, Dimension dimension, std::string_view what) {
  const auto units = units_of(dimension);
  const auto expected = [&] {
    if (units.empty()) return std::string("write a plain number, such as 5 or 1e3, or 2%");
    return fmt::format("write a number and one of {}; a bare number is in {}", names(units),
                       units.front().name);
  };
  std::string_view rest = trim(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);  // from_chars does not accept a plus sign
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range)
    throw InputError(fmt::format("{}: \"{}\" is out of range; use 1e-300 to 1e300", what, text));
  if (error != std::errc{} || !std::isfinite(number))
    throw InputError(
        fmt::format("{}: \"{}\" does not start with a number; {}", what, text, expected()));
  const std::string_view name = trim(rest.substr(static_cast<std::size_t>(end - rest.data())));
  if (name.empty()) return number;
  if (units.empty() && name == "%") return number / 100;
  const Unit* unit = find_unit(units, name);
  if (unit == nullptr)
    throw InputError(
        fmt::format("{}: \"{}\" has the unknown unit \"{}\"; {}", what, text, name, expected()));
  const double value = number * unit->in_si;
  if (!std::isfinite(value))
    throw InputError(fmt::format("{}: \"{}\" is out of range; use 1e-300 to 1e300", what, text));
  return value;
}

double length_unit(std::string_view name) {
  const Unit* unit = find_unit(kLength, trim(name));
  if (unit == nullptr)
    throw InputError(
        fmt::format("\"{}\" is not a unit of length; use one of {}", name, names(kLength)));
  return unit->in_si;
}

std::string format_quantity(double value, Dimension dimension) {
  const auto units = display_units(dimension);
  if (units.empty()) return fmt::format("{:.4g}", value);
  const Unit* best = find_unit(units, si_unit(dimension));
  if (value != 0 && std::isfinite(value)) {
    // The largest unit in which the rounded number is at least 1: 999.99 Pa is 1 kPa.
    constexpr double kRoundsToOne = 0.99995;
    best = &units.front();
    for (const Unit& unit : units)
      if (std::abs(value) >= kRoundsToOne * unit.in_si) best = &unit;
  }
  return fmt::format("{:.4g} {}", value / best->in_si, best->name);
}

}  // namespace springlod::inline base
