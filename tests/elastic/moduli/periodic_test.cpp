#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"

namespace springlod::elastic {
namespace {

/// The cubic lattice of 6 + 12 neighbours, n^3 nodes 1 m apart, k = 1 N/m.
PeriodicNetwork lattice(int n) {
  PeriodicNetwork network;
  network.box = Vec3::Constant(n);
  const auto number = [n](int x, int y, int z) {
    return static_cast<std::uint32_t>(((z + n) % n * n + (y + n) % n) * n + (x + n) % n);
  };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        network.rest.emplace_back(x, y, z);
        for (int dz = 0; dz <= 1; ++dz)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const bool forward = dz > 0 || dy > 0 || (dy == 0 && dx > 0);
              if (!forward || dx * dx + dy * dy + dz * dz > 2) continue;
              network.a.push_back(number(x, y, z));
              network.b.push_back(number(x + dx, y + dy, z + dz));
              network.span.emplace_back(dx, dy, dz);
              network.stiffness.push_back(1);
            }
      }
  return network;
}

TEST_CASE("The periodic lattice has E = 2.5 k / a and nu = 1/4") {
  const PeriodicModuli m = periodic_stretch(lattice(3));
  CHECK(m.young == Approx(2.5).epsilon(1e-9));
  CHECK(m.poisson == Approx(0.25).margin(1e-9));
  CHECK(m.eq2_young == Approx(2.5).epsilon(1e-9));
}

TEST_CASE("A periodic network of unequal springs is softer than eq. 2") {
  PeriodicNetwork network = lattice(4);
  for (std::size_t s = 0; s < network.stiffness.size(); ++s)
    network.stiffness[s] = s % 5 == 0 ? 0.2 : 1.2;
  const PeriodicModuli m = periodic_stretch(network);
  CHECK(m.young < 0.99 * m.eq2_young);
  CHECK(m.young > 0.7 * m.eq2_young);
}

TEST_CASE("A periodic network with arrays of inconsistent sizes is rejected") {
  PeriodicNetwork network = lattice(3);
  network.stiffness.pop_back();
  CHECK_THROWS_AS(periodic_stretch(network), InputError);
  network = lattice(3);
  network.b[5] = 27;
  CHECK_THROWS_AS(periodic_stretch(network), InputError);
}

}  // namespace
}  // namespace springlod::elastic
