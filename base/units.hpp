#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/choice.hpp"

namespace springlod::inline base {

/// What a number measures. Everything inside is SI; scripts may write "5 mm" or "1 MPa".
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

/// Name of the SI unit, e.g. "Pa".
std::string_view si_unit(Dimension dimension);

/// Reads "5 mm", "5mm", "1e3 kg/m3" or a bare "5" (SI) as an SI number.
/// `what` names the quantity in messages. Throws InputError naming the units that are known.
double parse_quantity(std::string_view text, Dimension dimension, std::string_view what);

/// Metres in one unit of length: "mm" -> 0.001. Throws InputError.
double length_unit(std::string_view name);

/// A short human form with an SI prefix, e.g. 0.002 -> "2 mm", 1e7 Pa -> "10 MPa"; 4 digits.
std::string format_quantity(double value, Dimension dimension);

}  // namespace springlod::inline base
