// Reads the bytes as a .vdb file. OpenVDB crashes on many damaged files, so load_vdb lets a child
// process try first. What is fuzzed is that nothing gets past this trial: the second reading, in
// this process, and the checks of what it gives.

#include <cstddef>
#include <cstdint>
#include <fstream>

#include <pthread.h>
#include <sanitizer/common_interface_defs.h>

#include "base/error.hpp"
#include "voxelize/lattice/lattice.hpp"
#include "voxelize/vdb_file.hpp"

namespace {

constexpr const char* kPath = "input.vdb";  // in the current folder
constexpr std::size_t kMostCells = 20'000;  // of a grid that becomes a lattice

// libFuzzer would take a crash of the child for one of its own.
void let_children_crash() {
  pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  let_children_crash();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ofstream(kPath, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const auto grid = springlod::voxelize::load_vdb(kPath);
    if (grid.cells.size() <= kMostCells) springlod::voxelize::build_lattice(grid);
  } catch (const springlod::Error&) {
  }
  return 0;
}
