#include "scripting/engine/api.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace springlod::scripting {

namespace {

template <class Entries>
auto find_by_name(const Entries& entries, std::string_view name) {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

/// Calls visit(parameter) for everything that is read or shown.
template <class Visit>
void for_each_parameter(const Api& api, const Visit& visit) {
  const auto of_function = [&](const FunctionEntry& entry) {
    for (const Parameter& parameter : entry.arguments) visit(parameter);
    for (const Parameter& parameter : entry.options) visit(parameter);
  };
  for (const FunctionEntry& entry : api.functions()) of_function(entry);
  for (const TypeEntry& type : api.types()) {
    for (const FieldEntry& field : type.fields) visit(field.parameter);
    for (const FunctionEntry& method : type.methods) of_function(method);
  }
  for (const RecordEntry& record : api.records())
    for (const Parameter& field : record.fields) visit(field);
}

void check_choices(const Api& api, std::vector<std::string>& missing) {
  const std::map<std::string, Words> all = api.choices();
  for_each_parameter(api, [&](const Parameter& parameter) {
    if (parameter.choices.empty()) return;
    if (all.at(parameter.choices.name).names() != parameter.choices.names())
      missing.push_back(
          fmt::format("choices.{}: a second table of that name", parameter.choices.name));
  });
}

void check_parameters(const std::vector<Parameter>& parameters, const std::string& owner,
                      std::vector<std::string>& missing) {
  for (const Parameter& parameter : parameters) {
    if (parameter.name.empty()) missing.push_back(fmt::format("{}: nameless parameter", owner));
    if (parameter.type.empty())
      missing.push_back(fmt::format("{}.{}: type", owner, parameter.name));
    if (parameter.help.empty())
      missing.push_back(fmt::format("{}.{}: help", owner, parameter.name));
  }
}

void check_function(const FunctionEntry& entry, const std::string& name,
                    std::vector<std::string>& missing) {
  if (entry.summary.empty()) missing.push_back(name + ": summary");
  if (entry.returns.empty()) missing.push_back(name + ": returns");
  if (!entry.call) missing.push_back(name + ": binding");
  if (entry.owner.empty()) {
    if (entry.group.empty()) missing.push_back(name + ": group");
    if (entry.example.empty()) missing.push_back(name + ": example");
    if (entry.errors.empty()) missing.push_back(name + ": errors");
  }
  check_parameters(entry.arguments, name, missing);
  check_parameters(entry.options, name, missing);
}

}  // namespace

std::vector<std::string> Words::names() const {
  std::vector<std::string> found;
  for (const Word& word : all) found.push_back(word.name);
  return found;
}

FunctionEntry& Api::add(FunctionEntry entry) {
  return functions_.emplace_back(std::move(entry));
}

TypeEntry& Api::add(TypeEntry entry) {
  for (FunctionEntry& method : entry.methods) method.owner = entry.name;
  return types_.emplace_back(std::move(entry));
}

RecordEntry& Api::add(RecordEntry entry) {
  return records_.emplace_back(std::move(entry));
}

void Api::add(ConstantEntry entry) {
  constants_.push_back(std::move(entry));
}

const FunctionEntry* Api::find_function(std::string_view name) const {
  return find_by_name(functions_, name);
}

const TypeEntry* Api::find_type(std::string_view name) const {
  return find_by_name(types_, name);
}

const RecordEntry& Api::record(std::string_view name) const {
  const RecordEntry* found = find_by_name(records_, name);
  if (found == nullptr) throw std::logic_error(fmt::format("record {} is not described", name));
  return *found;
}

std::map<std::string, Words> Api::choices() const {
  std::map<std::string, Words> found;
  for_each_parameter(*this, [&](const Parameter& parameter) {
    if (!parameter.choices.empty()) found.emplace(parameter.choices.name, parameter.choices);
  });
  return found;
}

std::vector<std::string> undocumented(const Api& api) {
  std::vector<std::string> missing;
  check_choices(api, missing);
  for (const FunctionEntry& entry : api.functions()) check_function(entry, entry.name, missing);
  for (const TypeEntry& type : api.types()) {
    if (type.summary.empty()) missing.push_back(type.name + ": summary");
    if (!type.describe) missing.push_back(type.name + ": describe");
    for (const FieldEntry& field : type.fields)
      check_parameters({field.parameter}, type.name, missing);
    for (const FunctionEntry& method : type.methods)
      check_function(method, type.name + ":" + method.name, missing);
  }
  for (const RecordEntry& record : api.records()) {
    if (record.summary.empty()) missing.push_back(record.name + ": summary");
    check_parameters(record.fields, record.name, missing);
  }
  for (const ConstantEntry& constant : api.constants())
    check_parameters({constant.parameter}, "module", missing);
  return missing;
}

}  // namespace springlod::scripting
