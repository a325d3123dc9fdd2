-- Redraws the figures of the paper from the bodies and scenes of studies/paper/scenes.lua. All
-- numbers are counted or computed here. figures.draw draws all figures.

local s = require "springlod"
local paper_numbers = require "studies.paper.numbers"
local paper_scenes = require "studies.paper.scenes"
local paper_variants = require "studies.paper.variants"

local figures = {}

-- Node counts of the paper at each level of a figure.
local function node_counts(...)
  local levels = {}
  for level, nodes in ipairs {...} do levels[level] = {nodes = nodes} end
  return levels
end
local function hb_counts(of)
  return {of.base, of["LOD-hb-1"], of["LOD-hb-2"]}
end
local paper = {
  lattices = node_counts(216, 125, 64, 27),
  cube = node_counts(216, 95, 41, 18),
  strong = node_counts(216, 180, 164, 158),
  ball = hb_counts(paper_numbers.roll),
  rods = hb_counts(paper_numbers.rods),
}

-- "LOD-hb-1: 161 nodes, 1878 ends", and the paper's counts on the next line.
local function heading(name, model, counts)
  local text = ("%s: %d nodes, %d ends\npaper: %d nodes"):format(name, model.node_count,
    model.end_count, counts.nodes)
  if counts.ends then text = ("%s, %d ends"):format(text, counts.ends) end
  return text
end

-- A panel for each level of a chain with the paper's counts in its heading; `options` apply to all.
local function level_panels(chain, variant, counts, options)
  local panels = {}
  for level, model in ipairs(chain.levels) do
    local name = paper_variants.label(variant, level - 1)
    local panel = {model, title = heading(name, model, counts[level])}
    for key, value in pairs(options or {}) do panel[key] = value end
    panels[level] = panel
  end
  return panels
end

-- Priority grouping and weak borders: the paper's LOD-hb.
local function simplify_hb(base, levels, seed)
  return s.simplify(base, {levels = levels, grouping = "priority", border = "weak", seed = seed})
end

-- The rods built from a mesh, so that their surface can be drawn. The cells are those of
-- paper_scenes.rods, but along x.
local function solid_rods()
  local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
  local materials = dofile(s.samples .. "/dumbbell_materials.lua")
  return s.lattice(s.voxelize(mesh, {cell = "10 cm", materials = materials}),
    {style = "centers", volumes = false})
end

-- The bodies of the paper, built once for all figures.
local function make_bodies(seed)
  local cube, cube_grid = paper_scenes.block()
  return {
    cube = cube, cube_grid = cube_grid,
    ball = simplify_hb((paper_scenes.ball()), 2, seed),
    rods = simplify_hb(solid_rods(), 2, seed),
  }
end

local cut_open = {0, 1, 0, -0.01} -- hides the half in front of the middle, as seen by the camera

-- Each figure: draws files into context.folder and returns a list of {file, title}.

local function lattices(context)
  local bodies = context.bodies
  local chain = s.refill(bodies.cube, bodies.cube_grid,
    {nodes = {125, 64, 27}, style = "lattice", lattice = "centers", volumes = false})
  local panels = {}
  for level = chain.coarsest, 0, -1 do
    local model = chain[level]
    local edge = math.floor(model.node_count ^ (1 / 3) + 0.5)
    panels[#panels + 1] = {
      model, title = heading(("edge of %d"):format(edge), model, paper.lattices[level + 1]),
    }
  end
  return context:draw("figure-1", "Figure 1: a cube by cubic lattices of four resolutions", panels,
    {azimuth = -60, elevation = 22})
end

-- Level 1: six nodes of 1 kg in a row, each merged from four base nodes. Level 2: the two in the
-- middle merged, with the base nodes distributed by `mass_rule`.
function figures.row_of_nodes(mass_rule)
  local nodes, springs, four, all = {}, {}, {}, {}
  for i = 1, 24 do
    nodes[i] = {(i - 2.5) / 4, 0, 0, mass = 1 / 4, volume = 1 / 64}
    if i > 1 then springs[i - 1] = {i - 1, i, k = 100} end
    if i % 4 == 0 then four[i // 4] = {i - 3, i - 2, i - 1, i} end
  end
  all[1], all[2] = four, {{3, 4}}
  return s.simplify(s.model{nodes = nodes, springs = springs},
    {levels = 2, grouping = all, mass = mass_rule, guards = false})
end

local function masses_in_a_row(context)
  local by_proportion, by_proximity =
    figures.row_of_nodes("proportional"), figures.row_of_nodes("proximity")
  local cases = {
    {name = "a) uniform", model = by_proportion[1]},
    {name = "b) two merged, by proportion", model = by_proportion[2]},
    {name = "c) two merged, by proximity", model = by_proximity[2]},
  }
  local panels, series = {}, {}
  for i, case in ipairs(cases) do
    local masses, points = {}, {}
    for j, node in ipairs(case.model:nodes()) do
      masses[j] = ("%.4g"):format(node.mass)
      -- Label only changed masses; more labels would overlap.
      points[j] = {node.x, node.mass, label = node.mass ~= 1 and masses[j] or nil}
    end
    panels[i] = {
      case.model, title = ("%s: masses %s kg"):format(case.name, table.concat(masses, ", ")),
    }
    series[i] = {name = case.name, points = points}
  end
  local title = "Figure 2: mass in one dimension, uniform and with two nodes merged"
  local drawn = context:draw("figure-2", title, panels, {
    columns = 1, width = 900, height = 200, azimuth = -90, elevation = 10, node_colour = "mass",
    node_size = "mass", node_radius = 0.2, springs = true,
  })
  s.chart(context.folder .. "/figure-2.svg", series,
    {title = "Figure 2: mass of the nodes", x_label = "place (m)", y_label = "mass (kg)"})
  drawn[#drawn + 1] = {file = "figure-2.svg", title = title}
  return drawn
end

local function cube_merged(context)
  local chain = s.simplify(context.bodies.cube, {levels = 3, seed = context.seed})
  return context:draw("figure-3", "Figure 3: standard merging of a cube, three times",
    level_panels(chain, "", paper.cube), {azimuth = -60, elevation = 22})
end

local function cube_with_strong_border(context)
  local chain = s.simplify(context.bodies.cube,
    {levels = 3, border = "strong", seed = context.seed})
  return context:draw("figure-4",
    "Figure 4: merging with a strong border, three times\nNodes inside in bold red",
    level_panels(chain, "", paper.strong),
    {azimuth = -60, elevation = 22, bold_inner_nodes = true})
end

-- Time of the largest elastic energy of a run, when it is compressed most [s].
local function most_compressed(run)
  local most = run.ledger[1]
  for _, energy in ipairs(run.ledger) do
    if energy.elastic > most.elastic then most = energy end
  end
  return most.time
end

local function ball_falls_and_rolls(context)
  local run = s.run(context.bodies.ball[0], paper_scenes.roll{duration = 1.6},
    {frame_rate = 100})
  return context:draw("figure-5",
    "Figure 5: scenario 1, a ball with a dense core and a soft shell thrown flat above a floor", {
      {run, time = run.first_contact / 2, title = "falls"},
      {run, time = most_compressed(run), title = "hits the floor"},
      {run, time = 1.5, title = "rolls"},
    }, {elevation = 10})
end

local function core_and_shell(context)
  return context:draw("figure-6",
    "Figure 6: dense core, soft shell\nCut open: core red, shell green",
    level_panels(context.bodies.ball, "hb", paper.ball), {cut = cut_open})
end

local function rods_solid_and_wire(context)
  local panels = {}
  for _, solid in ipairs {true, false} do
    for level = 0, 1 do
      local model = context.bodies.rods[level]
      panels[#panels + 1] = {
        model, surface = solid, nodes = not solid, springs = not solid,
        title = heading(paper_variants.label("hb", level), model, paper.rods[level + 1]),
      }
    end
  end
  return context:draw("figure-7",
    "Figure 7: two stiff rods joined by rubber, solid and as springs\n"
    .. "Solid, both are the same mesh: a level carries it with fewer nodes", panels,
    {columns = 2, width = 600, height = 300, azimuth = -78, elevation = 20})
end

local function throw_at_wall(context)
  local scene = paper_scenes.wall()
  scene.throw.turn = {axis = {0, 1, 0}, angle = "90 deg"} -- upright
  scene.duration = 1
  local rods = context.bodies.rods
  local runs = {s.run(rods[0], scene), s.run(rods[1], scene)}
  local panels = {}
  for _, time in ipairs {0, 0.13, 0.3, 0.5, 0.9} do
    for level, run in ipairs(runs) do
      local model = rods[level - 1]
      panels[#panels + 1] = {
        run, time = time,
        title = ("%s, %d nodes"):format(paper_variants.label("hb", level - 1), model.node_count),
      }
    end
  end
  return context:draw("figure-8", "Figure 8: scenario 2, two rods thrown at a wall\n"
    .. "Drawn: the mesh, carried by the nodes of either model", panels,
    {columns = 2, width = 480, height = 330, camera = "fixed", azimuth = -115, surface = true,
      nodes = false, springs = false})
end

-- Eq. 2 on the nodes: Young's modulus in the first row, density in the second.
local function eq2_on_nodes(context, name, chain, counts, options)
  local panels = {}
  for _, quantity in ipairs {"young", "density"} do
    for _, panel in ipairs(level_panels(chain, "hb", counts, {node_colour = quantity})) do
      panels[#panels + 1] = panel
    end
  end
  options.columns = #chain.levels
  return context:draw("figure-e-density-" .. name,
    ("Young's modulus and density of every node by eq. 2: %s"):format(name), panels, options)
end

local function eq2_of_ball(context)
  return eq2_on_nodes(context, "ball", context.bodies.ball, paper.ball,
    {height = 460, cut = cut_open})
end

local function eq2_of_rods(context)
  return eq2_on_nodes(context, "rods", context.bodies.rods, paper.rods,
    {width = 560, height = 260, azimuth = -80, elevation = 20, cut = cut_open, springs = true})
end

-- In the order of the paper; eq. 2 last.
local all_figures = {
  lattices, masses_in_a_row, cube_merged, cube_with_strong_border, ball_falls_and_rolls,
  core_and_shell, rods_solid_and_wire, throw_at_wall, eq2_of_ball, eq2_of_rods,
}

local Context = {}
Context.__index = Context

-- Renders folder/name.png and returns {{file, title}}.
function Context:draw(name, title, panels, options)
  local complete = {width = 420, height = 400, nodes = true, springs = true, surface = false}
  for key, value in pairs(options or {}) do complete[key] = value end
  complete.title = title
  complete.width = math.floor(complete.width * self.scale)
  complete.height = math.floor(complete.height * self.scale)
  s.render(("%s/%s.png"):format(self.folder, name), panels, complete)
  return {{file = name .. ".png", title = title:match("^[^\n]*")}}
end

-- Draws all figures into the folder and returns a list of {file, title}; `file` is a name without
-- folder. Options: seed (of the simplification; default: s.seed), quick (small pictures).
function figures.draw(folder, options)
  options = options or {}
  local seed = options.seed or s.seed
  local context = setmetatable({
    folder = folder, seed = seed, bodies = make_bodies(seed), scale = options.quick and 0.7 or 1,
  }, Context)
  local list = {}
  for _, draw in ipairs(all_figures) do
    for _, drawn in ipairs(draw(context)) do list[#list + 1] = drawn end
  end
  return list
end

return figures
