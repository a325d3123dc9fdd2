-- What contacts, corners and small bodies cost in a run, as ratios of processor time measured in
-- one process: springlod run bench/run_costs.lua [-- MESH]
--
-- A time per step is the difference between a long and a short run, so that what is done once per
-- run does not count. Each is the least of several.

local s = require "springlod"

local repeats = 3
local gravity = {0, 0, -9.81}

local function least(count, measure)
  local best = math.huge
  for _ = 1, count do best = math.min(best, measure()) end
  return best
end

local function processor_time(model, scene, options)
  local how = {frame_rate = 0, ledger = false, sleep = 0, quiet = true}
  for name, value in pairs(options) do how[name] = value end
  return least(repeats, function()
    local start = os.clock()
    s.run(model, scene, how)
    return os.clock() - start
  end)
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

-- Processor time per simulated second, from the time `settled` [s] on.
local function cost(model, scene, settled, duration, options)
  return (processor_time(model, scene(settled + duration), options)
    - processor_time(model, scene(settled), options)) / duration
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

local function bodies(mesh)
  local list = {
    {name = "block", base = lattice({16, 16, 16}, 0.0125, "1 MPa")},
    {name = "bar", base = lattice({10, 10, 40}, 0.01, "1 MPa")},
  }
  if mesh then
    local grid = s.voxelize(s.import(mesh), {
      cell = s.import(mesh).bounds.diagonal / 40,
      materials = {default = {young = "1 MPa", density = 1000}},
    })
    list[#list + 1] = {name = "mesh", base = s.lattice(grid, {hinges = "fill"})}
  end
  return list
end

local function contact_costs(body, rows)
  local chain = levels(body.base)
  for level = 0, chain.coarsest do
    local model = chain[level]
    local flight = cost(model, scenes(model, 1e4, {spin = {1, 2, 3}}, {}), 0.02, 0.3, {})
    for _, contact in ipairs(level == 0 and {"nodes"} or {"nodes", "surface"}) do
      for _, stiffness in ipairs{"auto", 1e5, 1e7, 1e9} do
        local function ratio(height, throw)
          local obstacle = {friction = 0.5, stiffness = stiffness}
          local c = cost(model, scenes(model, height, throw, obstacle), 0.05, 0.4,
            {contact = contact})
          return c / flight
        end
        rows[#rows + 1] = {
          body = body.name, level = level, nodes = model.node_count, contact = contact,
          stiffness = stiffness, bouncing = ratio(0.02, {velocity = {0.2, 0, -1}}),
          rolling = ratio(0.001, {velocity = {0.5, 0, 0}, spin = {0, 5, 0}}),
        }
      end
    end
  end
end

local function volume_costs(rows)
  local function chain(young, volumes)
    return levels(lattice({12, 12, 24}, 0.2 / 12, young, {volumes = volumes}))
  end
  local cases = {
    {name = "in flight", young = "1 MPa", height = 100, throw = {spin = {1, 2, 3}}},
    {name = "rolling", young = "1 MPa", height = 0.001, throw = {velocity = {0.5, 0, 0}}},
    {name = "thrown at 0.35 of the wave speed", young = "0.2 MPa", height = 0.1,
     throw = {velocity = {1, 0, -5}, spin = {1, 2, 3},
              turn = {axis = {1, 0.5, 0.2}, angle = 0.6}}},
  }
  for _, case in ipairs(cases) do
    local without, with = chain(case.young, false), chain(case.young, true)
    for level = 0, with.coarsest do
      local function of(model)
        local scene = scenes(model, case.height, case.throw, {friction = 0.5})
        return cost(model, scene, 0.001, 0.15, {precision = "single"})
      end
      rows[#rows + 1] = {case = case.name, level = level, nodes = with[level].node_count,
                         ratio = of(with[level]) / of(without[level])}
    end
  end
end

local function small_costs(rows)
  local small = levels(lattice({8, 8, 8}, 0.0125, "1 MPa"))[2]
  local large = levels(lattice({20, 20, 20}, 0.005, "1 MPa"))[1]
  for _, precision in ipairs{"single", "double"} do
    local function of(model)
      local scene = scenes(model, 1e4, {spin = {1, 2, 3}}, {})
      local options = {precision = precision, step = 1e-4}
      return cost(model, scene, 0.01, 2e4 / model.spring_count, options) / model.spring_count
    end
    rows[#rows + 1] = {precision = precision, nodes = small.node_count, large = large.node_count,
                       ratio = of(small) / of(large)}
  end
end

local function print_rows(title, rows, columns)
  print("\n" .. title)
  print(s.format_table(rows, {columns = columns}))
end

local contacts, volumes, small = {}, {}, {}
for _, body in ipairs(bodies(arg[1])) do contact_costs(body, contacts) end
print_rows("Time of a run with contact over that in flight", contacts,
  {"body", "level", "nodes", "contact", "stiffness", "bouncing", "rolling"})
volume_costs(volumes)
print_rows("Time of a run with corners over that without", volumes,
  {"case", "level", "nodes", "ratio"})
small_costs(small)
print_rows("Time per spring of a small level over that of a large one", small,
  {"precision", "nodes", "large", "ratio"})
