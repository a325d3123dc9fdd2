-- What contacts, corners and small bodies cost in a run, as ratios of processor time measured in
-- one process:
--   springlod run bench/run_costs.lua [-- MESH [UNIT]]
--   springlod run bench/run_costs.lua -- accuracy [BODY...]
-- The second form measures only contacts, on the bodies of the accuracy study.
--
-- A time is the difference between a long and a short run, so that what is done once per run does
-- not count. Runs that are compared take turns, and each time is the least of several.

local s = require "springlod"
local accuracy = require "studies.accuracy.bodies"
local intervals = require "lib.intervals"
local lists = require "lib.lists"

local repeats = 4
local gravity = {0, 0, -9.81}

local function processor_time(case, duration)
  local how = {frame_rate = 0, ledger = false, sleep = 0, quiet = true}
  for name, value in pairs(case.options or {}) do how[name] = value end
  local start = os.clock()
  s.run(case.model, case.scene(duration), how)
  return os.clock() - start
end

-- Processor times of the cases {model, scene, short, long, options} between the times `short` and
-- `long` [s] of their runs, per simulated second.
local function costs(cases)
  local least = {}
  for _ = 1, repeats do
    for i, case in ipairs(cases) do
      for _, until_then in ipairs{"short", "long"} do
        local key = until_then .. i
        local time = processor_time(case, case[until_then])
        least[key] = math.min(least[key] or math.huge, time)
      end
    end
  end
  local times = {}
  for i, case in ipairs(cases) do
    times[i] = (least["long" .. i] - least["short" .. i]) / (case.long - case.short)
  end
  return times
end

-- Scenarios by duration. `height`: of the lowest point at the start, in sizes of the body.
local function scenes(model, height, throw, obstacle)
  local bounds = model.bounds
  local size = bounds.diagonal
  return function(duration)
    obstacle.plane = {0, 0, 1, bounds.low[3] - height * size}
    return s.scenario{gravity = gravity, duration = duration, obstacles = {obstacle}, throw = throw}
  end
end

local function lattice(size, cell, young, more)
  return s.lattice(s.grid{
    cell = cell, size = size, materials = {m = {young = young, density = 1000}},
    fill = function() return "m" end,
  }, more)
end

local function levels(base)
  return s.simplify(base, {levels = 2, grouping = "compact", seed = 1})
end

local function body_of(path, unit)
  local mesh = s.import(path, {unit = unit})
  local longest = 0
  for axis = 1, 3 do longest = math.max(longest, mesh.max[axis] - mesh.min[axis]) end
  local grid = s.voxelize(mesh, {
    cell = longest / 32, materials = {default = {young = "1 MPa", density = 1000}},
  })
  return s.lattice(grid, {hinges = "fill"})
end

-- Times of the short and the long runs [s].
local short, long = 0.05, 0.45

local function bodies(path, unit)
  local list = {
    {name = "block", base = lattice({16, 16, 16}, 0.0125, "1 MPa"), short = short, long = long},
    {name = "bar", base = lattice({10, 10, 40}, 0.01, "1 MPa"), short = short, long = long},
  }
  if path then
    list[#list + 1] = {name = "mesh", base = body_of(path, unit), short = short, long = long}
  end
  return list
end

-- The named bodies of the accuracy study, all if none is named. Their sizes differ by a factor of
-- ten, and so do the times of their bounces: the runs of each are those of the block, times its
-- size over the block's.
local function accuracy_bodies(names)
  local block_size = 0.2 * math.sqrt(3) -- [m]
  local wanted, makers = {}, {}
  for _, one in ipairs(accuracy) do makers[one.name] = one.make end
  if #names == 0 then names = lists.names_of(accuracy) end
  for i, name in ipairs(names) do
    if not makers[name] then
      error(("no body '%s' in the accuracy study; there are %s"):format(name,
        table.concat(lists.names_of(accuracy), ", ")), 0)
    end
    local base = makers[name]()
    local scale = base.bounds.diagonal / block_size
    wanted[i] = {name = name, base = base, short = scale * short, long = scale * long}
  end
  return wanted
end

-- Heights in sizes of the body.
local bouncing = {height = 0.02, throw = {velocity = {0.2, 0, -1}}}
local rolling = {height = 0.001, throw = {velocity = {0.5, 0, 0}, spin = {0, 5, 0}}}

-- Levels touch with their own nodes or at the base's surface; the base's nodes are its surface.
local function contacts_of(level)
  return level == 0 and {"nodes"} or {"nodes", "surface"}
end

local function contact_costs(body, rows)
  local chain = levels(body.base)
  for level = 0, chain.coarsest do
    local model = chain[level]
    local cases, kinds = {}, {}
    local function add(height, throw, obstacle, contact)
      cases[#cases + 1] = {model = model, scene = scenes(model, height, throw, obstacle),
                           short = body.short, long = body.long, options = {contact = contact}}
    end
    add(1e4, {spin = {1, 2, 3}}, {})
    for _, contact in ipairs(contacts_of(level)) do
      for _, stiffness in ipairs{"auto", 1e5, 1e7, 1e9} do
        kinds[#kinds + 1] = {contact = contact, stiffness = stiffness}
        for _, way in ipairs{bouncing, rolling} do
          add(way.height, way.throw, {friction = 0.5, stiffness = stiffness}, contact)
        end
      end
    end
    local times = costs(cases)
    for i, kind in ipairs(kinds) do
      rows[#rows + 1] = {
        body = body.name, level = level, nodes = model.node_count, contact = kind.contact,
        stiffness = kind.stiffness, bouncing = times[2 * i] / times[1],
        rolling = times[2 * i + 1] / times[1],
      }
    end
  end
end

local function volume_costs(rows)
  local young, density = 0.2e6, 1000
  local wave_speed = math.sqrt(young / density)
  local cases = {
    {name = "in flight", height = 100, throw = {spin = {1, 2, 3}}},
    {name = "rolling", height = 0.001, throw = {velocity = {0.5, 0, 0}}},
  }
  for _, part in ipairs{0.05, 0.1, 0.2, 0.35} do
    cases[#cases + 1] = {
      name = ("thrown at %g of the wave speed"):format(part), height = 0.1,
      throw = {velocity = {1, 0, -part * wave_speed}, spin = {1, 2, 3},
               turn = {axis = {1, 0.5, 0.2}, angle = 0.6}},
    }
  end
  local function chain(volumes)
    return levels(lattice({12, 12, 24}, 0.2 / 12, young, {volumes = volumes}))
  end
  local without, with = chain(false), chain(true)
  for _, case in ipairs(cases) do
    for level = 0, with.coarsest do
      local function run_of(model)
        return {model = model, scene = scenes(model, case.height, case.throw, {friction = 0.5}),
                short = 0.001, long = 0.25, options = {precision = "single"}}
      end
      local times = costs{run_of(without[level]), run_of(with[level])}
      rows[#rows + 1] = {case = case.name, level = level, nodes = with[level].node_count,
                         ratio = times[2] / times[1]}
    end
  end
end

local function small_costs(rows)
  local small = levels(lattice({8, 8, 8}, 0.0125, "1 MPa"))[2]
  local large = levels(lattice({20, 20, 20}, 0.005, "1 MPa"))[1]
  for _, precision in ipairs{"single", "double"} do
    local function run_of(model)
      return {model = model, scene = scenes(model, 1e4, {spin = {1, 2, 3}}, {}),
              short = 0.01, long = 0.01 + 2e4 / model.spring_count,
              options = {precision = precision, step = 1e-4}}
    end
    local times = costs{run_of(small), run_of(large)}
    rows[#rows + 1] = {
      precision = precision, nodes = small.node_count, large = large.node_count,
      ratio = times[1] / small.spring_count / (times[2] / large.spring_count),
    }
  end
end

local function print_rows(title, rows, columns)
  print("\n" .. title)
  print(s.format_table(rows, {columns = columns}))
end

-- Least, median and largest ratio of each kind of contact over the bodies, with floors of 1e5 N/m3
-- apart: a body sinks into those by several cells, so that many of its points touch.
local function summary(rows)
  local kinds, order = {}, {}
  for _, row in ipairs(rows) do
    local floor = row.stiffness == 1e5 and "1e5" or "auto, 1e7, 1e9"
    local key = ("%d %s %s"):format(row.level, row.contact, floor)
    if not kinds[key] then
      kinds[key] = {level = row.level == 0 and "base" or row.level, contact = row.contact,
                    floor = floor, bouncing = {}, rolling = {}}
      order[#order + 1] = kinds[key]
    end
    table.insert(kinds[key].bouncing, row.bouncing)
    table.insert(kinds[key].rolling, row.rolling)
  end
  for _, kind in ipairs(order) do
    for _, way in ipairs{"bouncing", "rolling"} do kind[way] = intervals.spread(kind[way]) end
  end
  return order
end

local function measure_contacts(list)
  local rows = {}
  for _, body in ipairs(list) do
    s.say(body.name)
    contact_costs(body, rows)
  end
  print_rows("Time of a run with contact over that in flight", rows,
    {"body", "level", "nodes", "contact", "stiffness", "bouncing", "rolling"})
  print_rows("The same over all bodies: least, median and largest", summary(rows),
    {"level", "contact", "floor", "bouncing", "rolling"})
end

if arg[1] == "accuracy" then
  measure_contacts(accuracy_bodies({table.unpack(arg, 2)}))
  return
end
local volumes, small = {}, {}
measure_contacts(bodies(arg[1], arg[2]))
volume_costs(volumes)
print_rows("Time of a run with corners over that without", volumes,
  {"case", "level", "nodes", "ratio"})
small_costs(small)
print_rows("Time per spring of a small level over that of a large one", small,
  {"precision", "nodes", "large", "ratio"})
