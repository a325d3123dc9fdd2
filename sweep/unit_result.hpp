#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace springlod::sweep {

/// One value of a row; std::monostate: none. Numbers are kept to the last bit, infinite ones and
/// NaN too.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;
using Row = std::vector<Cell>;  ///< one cell for each column of the stage

/// What a unit has given, or why it failed, and how it was run.
struct UnitResult {
  std::uint64_t unit = 0;
  std::vector<Row> rows{};
  std::string failure{};  ///< message; empty: the rows are the result
  std::string version{};  ///< of springlod
  std::string target{};   ///< instruction set of the fast kernels, "AVX2"
  std::string blas{};     ///< kernels of BLAS, "Haswell"
  std::string host{};
  std::string log{};         ///< path of what the unit printed, below the folder of the plan
  int signal = 0;            ///< that ended the process [signal number]; 0: none
  double seconds = 0;        ///< by the clock
  std::uint64_t memory = 0;  ///< largest of the process while it ran [bytes]
};

/// As JSON, and back. from_text throws InputError for damaged text.
std::string to_text(const UnitResult& result);
UnitResult result_from_text(const std::string& text);

}  // namespace springlod::sweep
