#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/engine/call.hpp"

namespace springlod::scripting {

namespace value_list_detail {

/// See values_at.
std::vector<std::shared_ptr<const void>> boxed_values_at(Call& call, int number, TypeTag tag,
                                                         const std::string& rule);
/// See begins_with.
bool begins_with(Call& call, int number, TypeTag tag);

}  // namespace value_list_detail

/// The T at argument `number`, or the list of them. Throws InputError for any other value, among
/// them an empty list. `rule`: what the argument must be.
template <class T>
std::vector<std::shared_ptr<const T>> values_at(Call& call, int number, const std::string& rule) {
  std::vector<std::shared_ptr<const T>> values;
  for (auto& value : value_list_detail::boxed_values_at(call, number, &kValueName<T>, rule))
    values.push_back(std::static_pointer_cast<const T>(std::move(value)));
  return values;
}

/// Whether argument `number` is a T, or a list that begins with one.
template <class T>
bool begins_with(Call& call, int number) {
  return value_list_detail::begins_with(call, number, &kValueName<T>);
}

}  // namespace springlod::scripting
