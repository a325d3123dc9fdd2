#include "sim/correction/step_nodes.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace springlod;
using namespace springlod::sim;

namespace {

/// Each node goes from its number along x to `to` along x.
class Lines final : public StepPaths {
 public:
  explicit Lines(double to) : to_(to) {}
  void read(std::span<const std::uint32_t> nodes, std::span<PaddedPath> paths) const override {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      paths[i] = {Padded(nodes[i], 0, 0, 0), Padded(to_, 0, 0, 0)};
  }

 private:
  double to_;
};

}  // namespace

TEST_CASE("Nodes that are kept have their slots in the next steps, with new paths") {
  StepNodes nodes(10);
  const Lines first(20);
  nodes.begin(first);
  CHECK(nodes.slot(7) == 0);
  CHECK(nodes.slot(3) == 1);
  CHECK_FALSE(nodes.shared());
  nodes.keep();
  CHECK(nodes.slot(5) == 2);  // only in this step
  nodes.move(0, Vec3(1, 2, 3));
  CHECK(nodes.corrected_path(7).from == Vec3(7, 0, 0));
  CHECK(nodes.corrected_path(7).to == Vec3(21, 2, 3));
  CHECK(nodes.take_travel() == Approx(std::sqrt(14)));
  CHECK(nodes.take_travel() == 0);

  const Lines second(30);
  nodes.begin(second);
  CHECK(nodes.nodes() == std::vector<std::uint32_t>{7, 3});
  CHECK_FALSE(nodes.has(5));
  CHECK(nodes.corrected_path(7).to == Vec3(30, 0, 0));
  CHECK(nodes.path(1).from == Vec3(3, 0, 0));
  CHECK(nodes.at(1) == Vec3(30, 0, 0));
  CHECK(nodes.slot(3) == 1);
  CHECK(nodes.shared());
  nodes.keep();

  nodes.begin(first);
  CHECK(nodes.shared());
  nodes.keep_none();
  nodes.begin(first);
  CHECK(nodes.count() == 0);
  CHECK_FALSE(nodes.shared());
  CHECK(nodes.slot(3) == 0);
}
