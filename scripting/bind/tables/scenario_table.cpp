#include "scripting/bind/tables/scenario_table.hpp"

#include <string_view>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "scripting/bind/tables/values.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kGroup = "Simulation";

constexpr std::string_view kAutomatic = "auto";  // stiffness of an obstacle

// {nx, ny, nz, offset}
sim::Plane read_plane(lua_State* L, int table, const std::string& owner) {
  if (!lua_istable(L, table) || lua_rawlen(L, table) != 4)
    throw InputError(owner + " must be {nx, ny, nz, offset}: solid where n . x < offset");
  double value[4];
  for (int i = 0; i < 4; ++i) {
    lua_rawgeti(L, table, i + 1);
    value[i] = usual_quantity_at(L, -1, i == 3 ? Dimension::length : Dimension::number,
                                 fmt::format("{}[{}]", owner, i + 1));
    lua_pop(L, 1);
  }
  const Vec3 normal(value[0], value[1], value[2]);
  if (!(normal.norm() > 0)) throw InputError(owner + ": the normal must be longer than 0");
  return {normal.normalized(), value[3]};
}

sim::SolidBox read_box(Call& call, int table, const std::string& owner) {
  TableReader reader = call.record(table, "Box", owner);
  sim::SolidBox box;
  Vec3 size = Vec3::Ones();
  reader.read("center", box.center);
  if (!reader.has("size")) reader.refuse("size", "given: {x, y, z}");
  reader.read("size", size);
  box.half_size = 0.5 * size;
  if (const int turn = reader.raw("turn"))
    box.rotation = read_turn(call, turn, owner + ".turn").toRotationMatrix();
  reader.finish();
  return box;
}

/// A number, or "auto".
void read_stiffness(Call& call, TableReader& reader, std::optional<double>& into) {
  const int value = reader.raw("stiffness");
  if (value == 0) return;
  lua_State* L = call.lua();
  const bool automatic =
      lua_type(L, value) == LUA_TSTRING && std::string_view(lua_tostring(L, value)) == kAutomatic;
  if (!automatic) reader.read("stiffness", into);
}

sim::Obstacle read_obstacle(Call& call, int table, const std::string& owner) {
  TableReader reader = call.record(table, "Obstacle", owner);
  sim::Obstacle obstacle;
  const int plane = reader.raw("plane");
  const int box = reader.raw("box");
  if ((plane != 0) == (box != 0)) reader.refuse("plane", "given, or else box, but not both");
  if (plane != 0) obstacle.shape = read_plane(call.lua(), plane, owner + ".plane");
  if (box != 0) obstacle.shape = read_box(call, box, owner + ".box");
  reader.read("name", obstacle.name);
  read_stiffness(call, reader, obstacle.stiffness);
  reader.read("friction", obstacle.friction);
  reader.read("damping", obstacle.damping);
  reader.finish();
  return obstacle;
}

void read_obstacles(Call& call, TableReader& reader, std::vector<sim::Obstacle>& into) {
  const int list = reader.raw("obstacles");
  if (list == 0) return;
  lua_State* L = call.lua();
  if (!lua_istable(L, list)) reader.refuse("obstacles", "a list of Obstacle tables");
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, list)); ++i) {
    lua_rawgeti(L, list, i);
    into.push_back(
        read_obstacle(call, lua_gettop(L), fmt::format("{}: obstacles[{}]", reader.owner(), i)));
    lua_pop(L, 1);
  }
}

void read_throw(Call& call, TableReader& scenario, sim::Throw& into) {
  const int table = scenario.raw("throw");
  if (table == 0) return;
  TableReader reader = call.record(table, "Throw", scenario.owner() + ": throw");
  into.placed = reader.has("position");
  reader.read("position", into.position);
  reader.read("velocity", into.velocity);
  reader.read("spin", into.spin);
  if (const int turn = reader.raw("turn"))
    into.rotation = read_turn(call, turn, reader.owner() + ".turn").toRotationMatrix();
  reader.finish();
}

void read_stop(Call& call, TableReader& scenario, std::optional<sim::StopRule>& into) {
  const int table = scenario.raw("stop");
  if (table == 0) return;
  sim::StopRule rule;
  TableReader reader = call.record(table, "Stop", scenario.owner() + ": stop");
  reader.read("speed", rule.speed);
  reader.read("hold", rule.hold);
  reader.finish();
  into = rule;
}

int scenario_binding(Call& call) {
  TableReader reader = call.options(1);
  return call.give(std::make_shared<const sim::Scenario>(scenario_from_table(call, reader)));
}

void describe_obstacles(Api& api) {
  const sim::Obstacle usual;
  api.add(RecordEntry{.name = "Turn",
                      .summary = "A rotation.",
                      .fields = {{.name = "axis",
                                  .type = "{x, y, z}",
                                  .fallback = "{0, 0, 1}",
                                  .help = "axis of the rotation, of any length"},
                                 {.name = "angle",
                                  .type = "quantity",
                                  .dimension = Dimension::angle,
                                  .fallback = "0",
                                  .help = "angle, right-handed about the axis"}},
                      .example = "turn = {axis = {0, 1, 0}, angle = \"30 deg\"}"});
  api.add(RecordEntry{.name = "Box",
                      .summary = "A solid box.",
                      .fields = {{.name = "center",
                                  .type = "{x, y, z}",
                                  .dimension = Dimension::length,
                                  .fallback = "{0, 0, 0}",
                                  .help = "centre of the box"},
                                 {.name = "size",
                                  .type = "{x, y, z}",
                                  .dimension = Dimension::length,
                                  .help = "full edge lengths along its axes"},
                                 {.name = "turn",
                                  .type = "Turn",
                                  .fallback = "none",
                                  .help = "rotation about its centre"}},
                      .example = "box = {center = {2.5, 0, 1}, size = {1, 4, 2}}"});
  api.add(RecordEntry{
      .name = "Obstacle",
      .summary = "A fixed obstacle: penalty contact with Coulomb friction.",
      .fields = {{.name = "plane",
                  .type = "{nx, ny, nz, offset}",
                  .fallback = "none",
                  .help = "solid where n . x < offset: {0, 0, 1, 0} is a floor at height 0; plane "
                          "or box must be given"},
                 {.name = "box", .type = "Box", .fallback = "none", .help = "a solid box"},
                 {.name = "name",
                  .type = "string",
                  .fallback = "\"\"",
                  .help = "name for labels and measure_from, such as \"wall\""},
                 {.name = "stiffness",
                  .type = "number or \"auto\"",
                  .fallback = fmt::format("\"{}\"", kAutomatic),
                  .help = "force per contact area and depth [N/m3]; \"auto\": from the stiffness "
                          "of the body's surface at each contact point"},
                 {.name = "friction",
                  .type = "number",
                  .range = Range{0, 1e6},
                  .fallback = fmt::format("{}", usual.friction),
                  .help = "Coulomb's coefficient"},
                 {.name = "damping",
                  .type = "quantity",
                  .dimension = Dimension::time,
                  .range = Range{0, 1000},
                  .fallback = fmt::format("{}", usual.damping),
                  .help = "contact damping time"}},
      .example = "{plane = {0, 0, 1, 0}, name = \"floor\", friction = 0.5}"});
}

void describe_throw(Api& api) {
  const sim::StopRule stop;
  api.add(RecordEntry{
      .name = "Throw",
      .summary = "Initial state of the body: rotated about its centre of mass, then translated.",
      .fields = {{.name = "position",
                  .type = "{x, y, z}",
                  .dimension = Dimension::length,
                  .fallback = "the position in the model",
                  .help = "position of the centre of mass"},
                 {.name = "velocity",
                  .type = "{x, y, z}",
                  .dimension = Dimension::velocity,
                  .fallback = "{0, 0, 0}",
                  .help = "velocity of every node"},
                 {.name = "spin",
                  .type = "{x, y, z}",
                  .dimension = Dimension::angular_velocity,
                  .fallback = "{0, 0, 0}",
                  .help = "angular velocity about the centre of mass"},
                 {.name = "turn",
                  .type = "Turn",
                  .fallback = "none",
                  .help = "rotation about the centre of mass"}},
      .example =
          "throw = {position = {0, 0, 2}, velocity = {\"10 m/s\", 0, 0}, spin = {0, 6, 0}}"});
  api.add(RecordEntry{.name = "Stop",
                      .summary = "Ends a run early, when the centre of mass has come to rest.",
                      .fields = {{.name = "speed",
                                  .type = "quantity",
                                  .dimension = Dimension::velocity,
                                  .range = Range{1e-9, 1e6},
                                  .fallback = fmt::format("{}", stop.speed),
                                  .help = "speed below which the body counts as at rest"},
                                 {.name = "hold",
                                  .type = "quantity",
                                  .dimension = Dimension::time,
                                  .range = Range{0, 1e5},
                                  .fallback = fmt::format("{}", stop.hold),
                                  .help = "minimum duration of rest"}},
                      .example = "stop = {speed = \"10 cm/s\", hold = 0.25}"});
}

}  // namespace

Eigen::AngleAxisd read_turn(const Call& call, int table, const std::string& owner) {
  TableReader reader = call.record(table, "Turn", owner);
  Vec3 axis = Vec3::UnitZ();
  double angle = 0;
  reader.read("axis", axis);
  reader.read("angle", angle);
  reader.finish();
  if (!(axis.norm() > 0)) reader.refuse("axis", "longer than 0");
  return Eigen::AngleAxisd(angle, axis.normalized());
}

sim::Scenario scenario_from_table(Call& call, TableReader& reader) {
  sim::Scenario scenario;
  reader.read("name", scenario.name);
  reader.read("gravity", scenario.gravity);
  reader.read("duration", scenario.duration);
  reader.read("measure_from", scenario.measure_from);
  read_obstacles(call, reader, scenario.obstacles);
  read_throw(call, reader, scenario.start);
  read_stop(call, reader, scenario.stop);
  reader.finish();
  validate(scenario);
  return scenario;
}

std::shared_ptr<const sim::Scenario> scenario_argument(Call& call, int number) {
  if (auto scenario = call.try_value<sim::Scenario>(number)) return scenario;
  if (!lua_istable(call.lua(), call.index(number)))
    call.refuse(number, "a Scenario or a table for s.scenario");
  const FunctionEntry* entry = call.session().api().find_function("scenario");
  TableReader reader(call.lua(), call.index(number), entry->options, "scenario");
  return std::make_shared<const sim::Scenario>(scenario_from_table(call, reader));
}

Parameter scenario_parameter() {
  return {.name = "scenario",
          .type = "Scenario",
          .help = "a Scenario, or a table of options for s.scenario"};
}

void describe_scenario(Api& api) {
  describe_obstacles(api);
  describe_throw(api);
  TypeBuilder<sim::Scenario> type("Conditions of a run: gravity, obstacles, throw and duration.",
                                  [](const sim::Scenario& scenario) {
                                    return fmt::format(
                                        "Scenario {}: {} s, {}", scenario.name, scenario.duration,
                                        counted(scenario.obstacles.size(), "obstacle"));
                                  });
  type.field("name", "string", "name of the scenario",
             [](const sim::Scenario& value) { return value.name; });
  type.field("duration", "number", "maximum simulated time [s]",
             [](const sim::Scenario& value) { return value.duration; });
  type.field("gravity", "{x, y, z}", "gravity [m/s2]",
             [](const sim::Scenario& value) { return value.gravity; });
  type.field("obstacle_count", "integer", "number of obstacles",
             [](const sim::Scenario& value) { return value.obstacles.size(); });
  type.field("measure_from", "string", "obstacle that the distance is measured from, or \"\"",
             [](const sim::Scenario& value) { return value.measure_from; });
  api.add(type.build());
  api.add(FunctionEntry{
      .name = "scenario",
      .group = kGroup,
      .summary = "Makes a scenario from gravity, obstacles, throw and duration.",
      .options =
          {{.name = "name", .type = "string", .fallback = "\"scenario\"", .help = "name in titles"},
           {.name = "gravity",
            .type = "{x, y, z}",
            .dimension = Dimension::acceleration,
            .fallback = "{0, 0, -9.81}",
            .help = "gravity"},
           {.name = "obstacles",
            .type = "list of Obstacle",
            .fallback = "none",
            .help = "floor, walls, boxes"},
           {.name = "throw",
            .type = "Throw",
            .fallback = "at rest at the position in the model",
            .help = "start position and velocities"},
           {.name = "duration",
            .type = "quantity",
            .dimension = Dimension::time,
            .range = Range{1e-9, 1e5},
            .fallback = fmt::format("{}", sim::Scenario{}.duration),
            .help = "maximum simulated time"},
           {.name = "stop",
            .type = "Stop",
            .fallback = "none",
            .help = "condition that ends a run early"},
           {.name = "measure_from",
            .type = "string",
            .fallback = "the horizontal displacement from the start",
            .help = "name of the obstacle from whose surface the distance at the end is "
                    "measured"}},
      .returns = "Scenario",
      .errors = "A value out of range; measure_from is not the name of an obstacle.",
      .example = "local scene = s.scenario{gravity = {0, 0, -9.81}, duration = 3,\n"
                 "  throw = {velocity = {30, 0, 0}},\n"
                 "  obstacles = {{plane = {0, 0, 1, 0}, friction = 0.5}}}",
      .call = scenario_binding});
}

}  // namespace springlod::scripting
