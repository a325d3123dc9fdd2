// The message on a part whose cells have another volume.

#include "voxelize/cells/resolution.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "tests/voxelize/shapes.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using Catch::Matchers::Contains;

namespace {

/// The fault of a part of `cells` cells of 10 cm, whose surface encloses `volume` [m3].
std::string fault(double volume, double cells) {
  TriangleMesh mesh;
  test::add_box(mesh, "box", {0, 0, 0}, {1, 1, 1});
  return volume_fault(mesh, {.part = "box", .parts = {0}, .volume = volume}, volume, cells, 0.1)
      .value_or("none");
}

}  // namespace

TEST_CASE("An error of the volume is in percent, a large one a ratio, and none without a volume") {
  CHECK(fault(1, 1000) == "none");
  CHECK_THAT(fault(1, 1200), Contains("has an error of +20 % (1.2 m3 against 1 m3 in the mesh)"));
  CHECK_THAT(fault(0.05, 1000),
             Contains("is 20 times as large as it should be (1 m3 against 0.05 m3 in the mesh)"));
  for (const double volume : {1e-21, 0.0, -1e-21, -1.0}) {
    CAPTURE(volume);
    CHECK_THAT(fault(volume, 1000),
               Contains("\"box\": its surface encloses no volume, and yet 1 m3 of cells") &&
                   Contains("check the mesh") && !Contains("%"));
  }
}
