#pragma once

#include <string>
#include <utility>

#include "base/error.hpp"

namespace springlod::scripting {

/// A key of a table of options that the table does not take. Its message lists what the table
/// takes; the call that reads the table may know where the option belongs.
class UnknownOption : public InputError {
 public:
  UnknownOption(std::string option, const std::string& message)
      : InputError(message), option_(std::move(option)) {}
  const std::string& option() const { return option_; }

 private:
  std::string option_;
};

}  // namespace springlod::scripting
