// Voxelization of a million triangles in 256^3 cells, compared with the bare OpenVDB call on the
// same mesh in the same run; imports, compared with reading in this process; and a whole
// `springlod convert` to about 100,000 nodes. Run by ./dev bench.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include "voxelize/cells/frame.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/import.hpp"
#include "voxelize/mesh/read_mesh.hpp"

namespace {

using namespace springlod;

// Two circles of points make 2 * 1000 * 500 triangles.
constexpr std::uint32_t kAround = 1000;
constexpr std::uint32_t kAcross = 500;
constexpr double kCells = 256;  // along the longest side
constexpr float kBand = 3;      // [cells], the value that voxelize() uses

/// A ring of radius `ring` whose cross-section has the radius `tube` [m].
TriangleMesh torus_mesh(double ring, double tube, std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / across;
      const double r = ring + tube * std::cos(v);
      mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), tube * std::sin(v));
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return i % around * across + j % across;
  };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.parts.push_back({"torus", "", 0, static_cast<std::uint32_t>(mesh.triangles.size())});
  return mesh;
}

/// A sphere of radius 1 m, the shape that fills the most cells per triangle.
TriangleMesh sphere_mesh(std::uint32_t sectors, std::uint32_t rings) {
  TriangleMesh mesh;
  mesh.positions = {-Vec3::UnitZ(), Vec3::UnitZ()};
  for (std::uint32_t r = 1; r < rings; ++r)
    for (std::uint32_t s = 0; s < sectors; ++s) {
      const double polar = std::numbers::pi * r / rings;
      const double azimuth = 2 * std::numbers::pi * s / sectors;
      mesh.positions.emplace_back(std::sin(polar) * std::cos(azimuth),
                                  std::sin(polar) * std::sin(azimuth), -std::cos(polar));
    }
  const auto at = [&](std::uint32_t r, std::uint32_t s) {
    return 2 + (r - 1) * sectors + s % sectors;
  };
  for (std::uint32_t s = 0; s < sectors; ++s) {
    mesh.triangles.push_back({0, at(1, s + 1), at(1, s)});
    mesh.triangles.push_back({1, at(rings - 1, s), at(rings - 1, s + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, s), at(r, s + 1), at(r + 1, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r + 1, s)});
    }
  }
  mesh.parts.push_back({"sphere", "", 0, static_cast<std::uint32_t>(mesh.triangles.size())});
  return mesh;
}

/// Input of meshToVolume: points in index space and triangles, in OpenVDB's types.
struct BareInput {
  std::vector<openvdb::Vec3d> points;
  std::vector<openvdb::Vec3I> triangles;
  openvdb::math::Transform::Ptr transform;

  BareInput(const TriangleMesh& mesh, double cell) {
    const voxelize::CellFrame frame = voxelize::frame_around(bounds(mesh), cell);
    for (const Vec3& position : mesh.positions) {
      const Vec3 p = frame.to_index(position);
      points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    transform = openvdb::math::Transform::createLinearTransform(cell);
    const Vec3 first = frame.center({0, 0, 0});
    transform->postTranslate({first.x(), first.y(), first.z()});
  }
  openvdb::FloatGrid::Ptr level_set() const {
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3d, openvdb::Vec3I> mesh(
        points, triangles);
    return openvdb::tools::meshToVolume<openvdb::FloatGrid>(mesh, *transform, kBand, kBand);
  }
};

/// Shortest wall-clock and processor times of a job [s].
struct Shortest {
  double real = std::numeric_limits<double>::infinity();
  double cpu = std::numeric_limits<double>::infinity();

  /// Returns the wall-clock time of this run.
  template <typename Job>
  double time(Job job) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    job();
    const double now =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    real = std::min(real, now);
    cpu = std::min(cpu, static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
    return now;
  }
};

/// voxelize() and the bare call alternately; the time is that of voxelize(). `ratio` and
/// `cpu_ratio` compare the shortest times; other load affects cpu_ratio less. The argument is the
/// number of threads, 0 for all.
void against_bare_call(benchmark::State& state, const TriangleMesh& mesh) {
  using tbb::global_control;
  const std::size_t all = global_control::active_value(global_control::max_allowed_parallelism);
  const auto threads = static_cast<std::size_t>(state.range(0));
  const global_control limit(global_control::max_allowed_parallelism, threads > 0 ? threads : all);
  openvdb::initialize();
  voxelize::VoxelizeOptions options;
  options.cell = bounds(mesh).sizes().maxCoeff() / kCells;
  const BareInput bare(mesh, *options.cell);
  Shortest of_bare;
  Shortest ours;
  std::size_t cells = 0;
  for (auto _ : state) {
    of_bare.time([&] { benchmark::DoNotOptimize(bare.level_set()); });
    state.SetIterationTime(
        ours.time([&] { cells = voxelize::voxelize(mesh, options).grid.cells.size(); }));
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["bare_ms"] = 1e3 * of_bare.real;
  state.counters["ratio"] = ours.real / of_bare.real;
  state.counters["cpu_ratio"] = ours.cpu / of_bare.cpu;
}

void voxelize_sphere(benchmark::State& state) {
  against_bare_call(state, sphere_mesh(kAround, kAcross + 1));
}
void voxelize_torus(benchmark::State& state) {
  against_bare_call(state, torus_mesh(1, 0.4, kAround, kAcross));
}
BENCHMARK(voxelize_sphere)
    ->Name("voxelize_sphere_1M")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(0)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(voxelize_torus)
    ->Name("voxelize_torus_1M")
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(0)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

void write_obj(const TriangleMesh& mesh, const std::filesystem::path& path) {
  std::ofstream out(path);
  out << "o body\n";
  for (const Vec3& p : mesh.positions) out << fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const Triangle& t : mesh.triangles)
    out << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
}

/// Imports a sphere and reads it in this process, alternately; the time is that of the import.
/// `more_ms` is what the import takes longer, of the shortest times. Both find the heap empty, as a
/// program does that reads one mesh: pages left from the reading before would be free for it, but
/// have to be copied in the child. The argument is the number of sectors; a sphere has about as
/// many triangles as its square.
void import_sphere(benchmark::State& state) {
  const auto sectors = static_cast<std::uint32_t>(state.range(0));
  const TriangleMesh mesh = sphere_mesh(sectors, sectors / 2);
  const auto path = std::filesystem::temp_directory_path() / "springlod_bench_import.obj";
  write_obj(mesh, path);
  const voxelize::ImportOptions options{.unit = 1, .up = voxelize::UpAxis::z};
  Shortest here;
  Shortest import;
  for (auto _ : state) {
    malloc_trim(0);
    here.time([&] { benchmark::DoNotOptimize(voxelize::read_mesh(path, options)); });
    malloc_trim(0);
    state.SetIterationTime(
        import.time([&] { benchmark::DoNotOptimize(voxelize::import_mesh(path, options)); }));
  }
  std::filesystem::remove(path);
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  state.counters["here_ms"] = 1e3 * here.real;
  state.counters["more_ms"] = 1e3 * (import.real - here.real);
}
BENCHMARK(import_sphere)
    ->ArgName("sectors")
    ->Arg(142)
    ->Arg(1000)
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// Runs the program on a sphere of 20,000 triangles: an asset of about 100,000 nodes and two
/// coarser levels.
void convert_100k_nodes(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() / "springlod_bench_convert";
  std::filesystem::create_directories(folder);
  write_obj(sphere_mesh(142, 71), folder / "sphere.obj");
  const std::string command = fmt::format(
      "'{}' --quiet convert '{}' --unit m --up z --cell 0.0356 --calibrate none -o '{}' > '{}'",
      SPRINGLOD_PROGRAM, (folder / "sphere.obj").string(), (folder / "sphere.glb").string(),
      (folder / "table.txt").string());
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) state.SkipWithError("convert failed");
  std::filesystem::remove_all(folder);
}
BENCHMARK(convert_100k_nodes)->Iterations(3)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
