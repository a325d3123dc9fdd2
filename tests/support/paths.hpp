#pragma once

#include <filesystem>

namespace springlod::test {

/// The checkout that the tests were built from.
std::filesystem::path source_folder();

/// The folder that they were built in; the program is app/springlod there.
std::filesystem::path build_folder();

}  // namespace springlod::test
