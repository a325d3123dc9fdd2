// Whole commands as users run them, on a sample, from start to the last file. Run by ./dev bench.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace {

namespace fs = std::filesystem;

/// A temporary folder, removed at the end.
class Folder {
 public:
  Folder() { fs::create_directories(path_); }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_ = fs::temp_directory_path() / "springlod_bench_jobs";
};

bool springlod(const std::string& arguments, const Folder& folder) {
  const std::string command = fmt::format("'{}' --quiet {} > '{}'", SPRINGLOD_PROGRAM, arguments,
                                          folder.file("output.txt"));
  return std::system(command.c_str()) == 0;
}

// 2,601 nodes and two coarser levels.
std::string convert_beast(const Folder& folder) {
  return fmt::format(
      "convert '{0}/beast.obj' --unit cm --cell 4mm --materials "
      "'{0}/beast_materials.lua' -o '{1}'",
      SPRINGLOD_SAMPLES, folder.file("beast.glb"));
}

void convert(benchmark::State& state) {
  const Folder folder;
  for (auto _ : state)
    if (!springlod(convert_beast(folder), folder)) state.SkipWithError("convert failed");
}

// A drop of 0.8 s of three levels, with tables only or with 24 frames and a video.
void compare(benchmark::State& state, const char* frames) {
  const Folder folder;
  if (!springlod(convert_beast(folder), folder)) state.SkipWithError("convert failed");
  const std::string arguments =
      fmt::format("compare '{}' --scenario '{}/drop.lua' --out '{}' {}", folder.file("beast.glb"),
                  SPRINGLOD_SAMPLES, folder.file("compared"), frames);
  for (auto _ : state)
    if (!springlod(arguments, folder)) state.SkipWithError("compare failed");
}

BENCHMARK(convert)
    ->Name("jobs/convert")
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compare, numbers, "--frames 0")
    ->Name("jobs/compare_numbers")
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compare, film, "--frames 24")
    ->Name("jobs/compare_film")
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
