#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/choice.hpp"

namespace springlod::inline base {

/// Physical dimension of a number. All values inside are in SI units; scripts may write "5 mm" or
/// "1 MPa".
enum class Dimension {
  number,            ///< no unit
  length,            ///< m: nm um mm cm dm m km in ft
  time,              ///< s: us ms s min
  mass,              ///< kg: mg g kg t
  pressure,          ///< Pa: Pa kPa MPa GPa
  density,           ///< kg/m3: kg/m3 kg/m^3 g/cm3 g/cm^3
  velocity,          ///< m/s: m/s cm/s mm/s km/h
  acceleration,      ///< m/s2: m/s2 m/s^2
  angle,             ///< rad: rad deg
  angular_velocity,  ///< rad/s: rad/s deg/s rpm
};

inline constexpr Choice<Dimension> kDimensions[] = {
    {Dimension::number, "number", ""},     {Dimension::length, "length", ""},
    {Dimension::time, "time", ""},         {Dimension::mass, "mass", ""},
    {Dimension::pressure, "pressure", ""}, {Dimension::density, "density", ""},
    {Dimension::velocity, "velocity", ""}, {Dimension::acceleration, "acceleration", ""},
    {Dimension::angle, "angle", ""},       {Dimension::angular_velocity, "angular_velocity", ""}};
constexpr ChoiceTable<Choice<Dimension>> choices(Dimension) {
  return {"dimension", kDimensions};
}

/// Names of the units of a dimension, the SI unit first.
std::vector<std::string> unit_names(Dimension dimension);

/// Name of the SI unit, such as "Pa".
std::string_view si_unit(Dimension dimension);

/// Parses "5 mm", "5mm", "1e3 kg/m3" or a bare "5" (SI unit) to a value in SI units. `what` is the
/// name of the quantity in error messages. Throws InputError with a list of the known units.
double parse_quantity(std::string_view text, Dimension dimension, std::string_view what);

/// Length of one unit in metres: "mm" -> 0.001. Throws InputError for an unknown unit.
double length_unit(std::string_view name);

/// Formats a value with 4 digits and an SI prefix: 0.002 -> "2 mm", 1e7 Pa -> "10 MPa".
std::string format_quantity(double value, Dimension dimension);

}  // namespace springlod::inline base
