#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace springlod::scripting {

/// The options of the API in the words of a command line. Messages of the program name an option as
/// scripts write it: `hinges = "fill"`. The reader of a command's message knows `--hinges fill`.
class FlagWords {
 public:
  /// `flags`: the flag of each option, such as {"cut_cells", "--cut-cells"}; "--no-..." is the flag
  /// of an option that it sets to false. `functions`: names that begin a message ("voxelize: ...")
  /// and mean nothing on a command line.
  void use(std::map<std::string, std::string> flags, std::set<std::string> functions);

  /// The message with its options as flags; as it is before `use`.
  std::string in_flags(std::string_view message) const;

 private:
  std::map<std::string, std::string> flags_;
  std::set<std::string> functions_;
};

}  // namespace springlod::scripting
