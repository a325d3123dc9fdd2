#include "tests/support/paths.hpp"

namespace springlod::test {

std::filesystem::path source_folder() {
  return SPRINGLOD_SOURCE_DIR;
}

std::filesystem::path build_folder() {
  return SPRINGLOD_BINARY_DIR;
}

}  // namespace springlod::test
