-- A page with everything that a page may have: springlod run make_page.lua -- FOLDER

local s = require "springlod"
local page = require "lib.page"

local folder = assert(arg[1], "give the folder to write to")
local mesh = s.import(s.samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {cell = "10 cm",
  materials = dofile(s.samples .. "/firm_dumbbell_materials.lua")})
local chain = s.simplify(s.lattice(grid, {style = "centers"}), {levels = 2})
local scene = s.scenario{
  duration = 0.4, throw = {position = {0, 0, 1}, velocity = {2, 0, 0}},
  obstacles = {{name = "floor", plane = {0, 0, 1, 0}},
               {name = "block", box = {center = {1, 0, 0.2}, size = {0.4, 1, 0.4}}}}}
local runs = s.compare(chain, scene)
local rows = runs:table()
s.animate(folder .. "/frames", runs, {width = 200, height = 150, frames = 12})
s.video(folder .. "/film.mp4", folder .. "/frames")
s.save_text(folder .. "/disc.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="40" '
  .. 'height="40"><circle cx="20" cy="20" r="15"/></svg>')
page.write(folder .. "/index.html", {
  command = "test", title = "Rods & rubber <thrown> \"at\" a floor",
  verdict = page.comparison_verdict(rows), line = "springlod run make_page.lua -- 'a b'",
  film = {path = folder .. "/film.mp4", panels = runs.labels, caption = "Twelve frames."},
  view = s.view(runs), facts = page.facts(rows),
  charts = {page.cost_error(rows), {
    {{name = "a line with intervals", points = {{1, 1, low = 0.5, high = 2}, {10, 3}, {100, 0}}},
     {name = "dashed", dashed = true, symbol = "none", points = {{1, 0.1}, {1000, 10}}},
     {name = "only in the legend", symbol = "ring", colour = "black", points = {}}},
    {title = "Logarithmic axes", x_label = "length [m]", y_label = "error [%]", log_x = true,
     log_y = true},
  }},
  pictures = {{path = folder .. "/frames/frame_0000.png", caption = "The first frame"},
              {path = folder .. "/disc.svg", caption = "A disc"},
              {path = folder .. "/none.png", caption = "a file that does not exist"}},
  tables = {page.comparison_table(rows)},
  provenance = page.provenance(chain, {{"script", "make_page.lua"}}),
})
-- Values on the nodes, no motion.
local values = {}
for i = 1, chain[0].node_count do values[i] = i end
page.write(folder .. "/still.html", {
  title = "Levels at rest", view = s.view(chain), values = {label = "number of the node",
  of = {base = values}},
})
