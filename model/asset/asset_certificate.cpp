#include "model/asset/asset_certificate.hpp"

#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/asset/field_reader.hpp"

namespace springlod::inline model {
namespace {

using nlohmann::json;

/// The scalar members, for the writer and the reader.
constexpr std::array<std::pair<const char*, double Certificate::*>, 10> kNumbers{
    {{"massError", &Certificate::mass_error},
     {"centerShift", &Certificate::center_shift},
     {"secondMomentError", &Certificate::second_moment_error},
     {"highestFrequency", &Certificate::highest_frequency},
     {"baseHighestFrequency", &Certificate::base_highest_frequency},
     {"stableStep", &Certificate::stable_step},
     {"baseStableStep", &Certificate::base_stable_step},
     {"cost", &Certificate::cost},
     {"baseCost", &Certificate::base_cost},
     {"tolerance", &Certificate::tolerance}}};

/// Those that not every level has.
constexpr std::array<std::pair<const char*, std::optional<double> Certificate::*>, 3>
    kOptionalNumbers{{{"blowError", &Certificate::blow_error},
                      {"firstPeriodError", &Certificate::first_period_error},
                      {"contactRatio", &Certificate::contact_ratio}}};

Certificate::Moduli read_moduli(const FieldReader& from) {
  return {.material = from.text("material"),
          .young = from.number("young"),
          .base_young = from.number("baseYoung"),
          .poisson = from.number("poisson"),
          .base_poisson = from.number("basePoisson")};
}

Certificate::Frequency read_frequency(const FieldReader& from) {
  return {.level = from.number("level"),
          .base = from.number("base"),
          .mac = from.number("mac"),
          .decay = from.optional_number("decay").value_or(0),
          .base_decay = from.optional_number("baseDecay").value_or(0)};
}

Certificate::Load read_load(const FieldReader& from) {
  return {.name = from.text("name"),
          .held_out = from.flag("heldOut"),
          .compliance = from.number("compliance"),
          .error = from.number("error")};
}

}  // namespace

json certificate_json(const Certificate& certificate) {
  json object{{"zeroModes", certificate.zero_modes},
              {"expectedZeroModes", certificate.expected_zero_modes}};
  for (const auto& [key, member] : kNumbers) object[key] = certificate.*member;
  for (const auto& [key, member] : kOptionalNumbers)
    if (certificate.*member) object[key] = *(certificate.*member);
  for (const Certificate::Moduli& m : certificate.moduli)
    object["moduli"].push_back({{"material", m.material},
                                {"young", m.young},
                                {"baseYoung", m.base_young},
                                {"poisson", m.poisson},
                                {"basePoisson", m.base_poisson}});
  for (const Certificate::Frequency& f : certificate.frequencies)
    object["frequencies"].push_back({{"level", f.level},
                                     {"base", f.base},
                                     {"mac", f.mac},
                                     {"decay", f.decay},
                                     {"baseDecay", f.base_decay}});
  for (const Certificate::Load& load : certificate.loads)
    object["loads"].push_back({{"name", load.name},
                               {"heldOut", load.held_out},
                               {"compliance", load.compliance},
                               {"error", load.error}});
  for (const std::string& text : certificate.unmet) object["misses"].push_back(text);
  return object;
}

Certificate read_certificate(const json& object, const std::string& owner) {
  const FieldReader from(object, owner);
  Certificate certificate;
  from.each("moduli", [&](const json& entry, const std::string& name) {
    certificate.moduli.push_back(read_moduli(FieldReader(entry, name)));
  });
  from.each("frequencies", [&](const json& entry, const std::string& name) {
    certificate.frequencies.push_back(read_frequency(FieldReader(entry, name)));
  });
  from.each("loads", [&](const json& entry, const std::string& name) {
    certificate.loads.push_back(read_load(FieldReader(entry, name)));
  });
  from.each("misses", [&](const json& entry, const std::string& name) {
    if (!entry.is_string())
      throw InputError(fmt::format("{} must be text, not {}", name, entry.type_name()));
    certificate.unmet.push_back(entry.get<std::string>());
  });
  for (const auto& [key, member] : kNumbers) certificate.*member = from.number(key);
  for (const auto& [key, member] : kOptionalNumbers)
    certificate.*member = from.optional_number(key);
  certificate.zero_modes = from.count("zeroModes");
  certificate.expected_zero_modes = from.count("expectedZeroModes");
  return certificate;
}

}  // namespace springlod::inline model
