// The contact option of levels in scripts.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

Ran with_ball(const std::string& script) {
  return springlod_run({"-e", R"(
    local s = require "springlod"
    local ball = s.lattice(s.grid{cell = "10 cm", size = {7, 7, 7},
      fill = function(x, y, z)
        return (x - 0.35) ^ 2 + (y - 0.35) ^ 2 + (z - 0.35) ^ 2 < 0.12 and "rubber" or nil
      end,
      materials = {rubber = {young = "1 MPa", density = 1000, damping = 0.002}}})
    local chain = s.simplify(ball, {grouping = "compact", keep = {0.3, 0.1}})
    local drop = {duration = 0.4, throw = {position = {0, 0, 0.6}},
                  obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}}}
    local function touches(model, contact)
      return s.run(model, drop, {contact = contact, quiet = true}).first_contact
    end
  )" + script});
}

}  // namespace

TEST_CASE("a level with contact on the surface reaches the floor at the same time as its base") {
  const Ran ran = with_ball(R"(
    local base = touches(ball)
    print(touches(ball, "surface") == base, touches(chain[0], "surface") == base)
    for level = 1, 2 do
      local bare, skinned = touches(chain[level], "nodes"), touches(chain[level], "surface")
      print(touches(chain[level]) == bare, math.abs(skinned - base) < 2e-3)
    end
    print(touches(chain[2]) > base + 0.02) -- its lowest node lies well inside
    local far = {}
    for i, contact in ipairs{"nodes", "surface"} do
      far[i] = s.ensemble(chain[1], drop, {starts = 1, contact = contact})[1].distance
    end
    print(far[1] ~= far[2])
    print(#s.compare(chain, drop, {contact = "surface"}):starts()))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "true\ttrue\ntrue\ttrue\ntrue\ttrue\ntrue\ntrue\n3\n");
}

TEST_CASE("a chain carries its contact points, and so does its asset") {
  const Ran ran = with_ball(R"(
    local skinned = s.simplify(ball, {grouping = "compact", keep = {0.3, 0.1}, contact = "surface"})
    print(s.info(chain).contact, s.info(skinned).contact)
    local path = os.tmpname()
    s.save(path, skinned)
    local loaded = s.load(path)
    os.remove(path)
    print(s.info(loaded).contact, s.info(s.certify(loaded, {modes = 1})).contact)
    print(touches(loaded[2]) == touches(chain[2], "surface"),
          touches(loaded[2], "nodes") == touches(chain[2]))
    local function distance(...) return s.ensemble(...)[1].distance end
    print(distance(loaded[1], drop) == distance(chain[1], drop, {contact = "surface"}))
    local function steps(...) return s.inspect((s.compare(...):table())) end
    print(steps(loaded, drop) == steps(chain, drop, {contact = "surface"}))
  )");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "nodes\tsurface\nsurface\tsurface\ntrue\ttrue\ntrue\ntrue\n");
}

TEST_CASE("an invalid contact is refused with the valid choices") {
  const Ran ran = with_ball(R"(touches(chain[1], "skin"))");
  CHECK(ran.exit_code != 0);
  CHECK_THAT(ran.err, Contains("contact") && Contains("nodes") && Contains("surface"));
}
