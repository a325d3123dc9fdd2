#include "sweep/unit_result.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace springlod::sweep {

namespace {

using nlohmann::ordered_json;

// JSON has no infinite numbers and no text that is not UTF-8: {"number": "inf"}, {"bytes": [255]}.
constexpr const char *kSpecial = "number", *kBytes = "bytes";

ordered_json json_of(double value) {
  if (std::isfinite(value)) return value;
  return {{kSpecial, std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"}};
}

ordered_json json_of(const std::string& text) {
  ordered_json json = text;
  try {
    json.dump();
    return json;
  } catch (const nlohmann::json::type_error&) {
    return {{kBytes, std::vector<std::uint8_t>(text.begin(), text.end())}};
  }
}

ordered_json json_of(const Cell& cell) {
  return std::visit(
      [](const auto& value) -> ordered_json {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::monostate>)
          return nullptr;
        else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::string>)
          return json_of(value);
        else
          return value;
      },
      cell);
}

double special_number(const std::string& word) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  return word == "inf" ? kInfinity : -kInfinity;
}

Cell cell_of(const ordered_json& json) {
  if (json.is_null()) return {};
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.contains(kBytes)) {
    const auto bytes = json.at(kBytes).get<std::vector<std::uint8_t>>();
    return std::string(bytes.begin(), bytes.end());
  }
  if (json.is_object()) return special_number(json.at(kSpecial));
  return json.get<std::string>();
}

}  // namespace

std::string to_text(const UnitResult& result) {
  ordered_json rows = ordered_json::array();
  for (const Row& row : result.rows) {
    ordered_json cells = ordered_json::array();
    for (const Cell& cell : row) cells.push_back(json_of(cell));
    rows.push_back(std::move(cells));
  }
  ordered_json json{{"unit", result.unit}};
  if (result.failure.empty())
    json["rows"] = std::move(rows);
  else
    json["failure"] = result.failure;
  if (result.signal != 0) json["signal"] = result.signal;
  json["run"] = {{"springlod", result.version}, {"target", result.target},
                 {"blas", result.blas},         {"host", result.host},
                 {"log", result.log},           {"seconds", result.seconds},
                 {"memory", result.memory}};
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

UnitResult result_from_text(const std::string& text) {
  try {
    const ordered_json json = ordered_json::parse(text);
    UnitResult result;
    result.unit = json.at("unit");
    result.failure = json.value("failure", "");
    result.signal = json.value("signal", 0);
    if (json.contains("rows"))
      for (const ordered_json& cells : json.at("rows")) {
        Row& row = result.rows.emplace_back();
        for (const ordered_json& cell : cells) row.push_back(cell_of(cell));
      }
    const ordered_json& run = json.at("run");
    run.at("springlod").get_to(result.version);
    run.at("target").get_to(result.target);
    result.blas = run.value("blas", "");
    run.at("host").get_to(result.host);
    run.at("log").get_to(result.log);
    run.at("seconds").get_to(result.seconds);
    run.at("memory").get_to(result.memory);
    return result;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("a damaged result: {}", error.what()));
  }
}

}  // namespace springlod::sweep
