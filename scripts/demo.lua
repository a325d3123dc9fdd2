-- Run the whole workflow on a sample, from a mesh to tables, charts and a video.
--
-- The sample is the second body of the paper, two stiff rods and a rubber joint: mesh -> cells ->
-- model -> levels -> a throw at a wall -> table, chart, video. ./dev demo runs this script.

local s = require "springlod"
local command = require "lib.command"
local paper_numbers = require "studies.paper.numbers"
local paper_variants = require "studies.paper.variants"

local parser = command.parser("demo", "Run the whole workflow on a sample: mesh, cells, model, "
  .. "levels, runs, table, chart and video.")
parser:argument("folder", "folder to write to"):default("out/demo")
parser:argument("starts", "starts of each level (one is not enough: bouncing is chaotic)")
  :convert(command.whole("starts", 1)):default("8")
parser:argument("frames", "frames of the video")
  :convert(command.whole("frames", 1)):default("60")
local args = parser:parse()
local folder, starts, frame_count = args.folder, args.starts, args.frames
local samples = s.samples

-- 1. From the mesh to the model, with nodes at the cell centers as in the paper.
local mesh = s.import(samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
local grid = s.voxelize(mesh, {
  cell = "10 cm",
  materials = dofile(samples .. "/dumbbell_materials.lua"),
})
local base = s.lattice(grid, {style = "centers"})
print(base)

-- 2. Two levels for each variant, saved as assets.
local counts, chains = {}, {}
local function count(name, model)
  local theirs = paper_numbers.rods[name] or {}
  counts[#counts + 1] = {
    name, model.node_count, model.end_count, theirs.nodes or "-", theirs.ends or "-",
  }
end
count("base", base)
for _, variant in ipairs(paper_variants) do
  local chain = s.simplify(base, {
    levels = 2, grouping = variant.grouping, border = variant.border, seed = s.seed,
  })
  for level = 1, 2 do count(paper_variants.label(variant.name, level), chain[level]) end
  s.save(("%s/%s-chain.glb"):format(folder, paper_variants.label(variant.name):lower()), chain)
  chains[variant.name] = chain
end
local count_columns = {"model", "nodes", "ends", "paper: nodes", "paper: ends"}
s.csv(folder .. "/counts.csv", counts, {columns = count_columns})
print()
print(s.format_table(counts, {columns = count_columns}))

-- 3. Run every level from the same starts.
local scene = s.scenario(dofile(samples .. "/throw_at_wall.lua"))
local rows, columns, timings, timing_columns = {}, nil, {}, nil
local series, compared = {}, {}
for i, variant in ipairs(paper_variants) do
  local runs = s.compare(chains[variant.name], scene,
    {starts = starts, jitter = 0.02, seed = s.seed, variant = variant.name})
  compared[variant.name] = runs
  local table_rows
  table_rows, columns = runs:table()
  local points = {}
  for _, row in ipairs(table_rows) do
    -- The base is the same in every comparison.
    if row.level > 0 or i == 1 then rows[#rows + 1] = row end
    points[#points + 1] = {
      1 / row.cost_ratio, row.surface_error_percent, label = row.level > 0 and row.label or nil,
    }
  end
  series[#series + 1] = {name = paper_variants.label(variant.name), points = points}
  local measured
  measured, timing_columns = runs:timings()
  for _, row in ipairs(measured) do timings[#timings + 1] = row end
end
s.csv(folder .. "/table.csv", rows, {columns = columns})
s.csv(folder .. "/timings.csv", timings, {columns = timing_columns})
print(s.format_table(rows, {columns = {
  "label", "nodes", "ends", "cost_ratio", "surface_error_percent", "shape_error_percent",
  "distance", "distance_spread", "ledger_error",
}}))

-- 4. Cost and error of each level.
for _, ending in ipairs {"svg", "png"} do
  s.chart(folder .. "/chart." .. ending, series, {
    title = "Two rods thrown at a wall: cost against error",
    x_label = "cost per simulated second (spring updates, base = 1)",
    y_label = "surface error (% of the body's diagonal)",
    log_x = true,
  })
end

-- 5. The video: the base and the two levels of LOD-hb, synchronized.
local frames = s.animate(folder .. "/frames", compared.hb,
  {frames = frame_count, camera = "follow"})
s.video(folder .. "/comparison.mp4", folder .. "/frames")
s.say(("%d frames, table.csv, counts.csv, chart.svg, comparison.mp4 and four assets are in %s")
  :format(frames, folder))
