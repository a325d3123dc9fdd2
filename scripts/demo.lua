-- Run the whole workflow on a sample, from a mesh to tables, charts and a video.
--
-- The sample is the second body of the paper, two stiff rods and a softer joint: mesh -> cells ->
-- model -> levels -> a throw at a wall -> table, chart, video, page. The levels are those of the
-- paper, and levels fitted to the base. ./dev demo runs this script.

local s = require "springlod"
local command = require "lib.command"
local comparison_table = require "lib.comparison_table"
local page = require "lib.page"
local paper_numbers = require "studies.paper.numbers"
local paper_variants = require "studies.paper.variants"
local show = require "lib.show"

local parser = command.parser("demo", "Run the whole workflow on a sample: mesh, cells, model, "
  .. "levels, runs, table, chart, video and a page, index.html, with all of it.")
command.add_out(parser, "out/demo", "folder", true)
parser:argument("starts", "the same as --starts"):args("?"):convert(command.whole("starts", 1))
  :target("starts_given")
parser:argument("frames", "the same as --frames"):args("?"):convert(command.whole("frames", 1))
  :target("frames_given")
parser:option("--starts", "starts of each level (one is not enough: bouncing is chaotic)")
  :convert(command.whole("--starts", 1)):default("8")
parser:option("--frames", "frames of the video"):convert(command.whole("--frames", 1)):default("60")
local args = parser:parse()
local folder = args.out
local starts, frame_count = args.starts_given or args.starts, args.frames_given or args.frames
local samples = s.samples

-- 1. From the mesh to the model, with nodes at the cell centers as in the paper.
local function make_base()
  local mesh = s.import(samples .. "/dumbbell.obj", {unit = "dm", up = "z"})
  local grid = s.voxelize(mesh, {
    cell = "10 cm",
    materials = dofile(samples .. "/firm_dumbbell_materials.lua"),
  })
  local base = s.lattice(grid, {style = "centers"})
  print(base)
  return base
end

-- 2. Two levels for each variant of the paper, and fitted ones with as many nodes; saved as assets.
local variants = table.move(paper_variants, 1, #paper_variants, 1, {})
variants[#variants + 1] = {name = "fit", grouping = "compact", border = "none", keep = {0.45, 0.2},
                           calibrate = "modes", contact = "surface"}

-- The names of a method, "LOD-hb" as in the paper, and of one of its levels, "LOD-hb level 2".
local function method_name(variant) return paper_variants.label(variant.name) end
local function level_name(name, level)
  return ("%s level %d"):format(paper_variants.label(name), level)
end

local function make_chains(base)
  local counts, chains = {}, {}
  local function count(name, paper_name, model)
    local theirs = paper_numbers.rods[paper_name] or {}
    counts[#counts + 1] = {
      name, model.node_count, model.end_count, theirs.nodes or "-", theirs.ends or "-",
    }
  end
  count("base", "base", base)
  for _, variant in ipairs(variants) do
    local chain = s.simplify(base, {
      levels = 2, keep = variant.keep, grouping = variant.grouping, border = variant.border,
      calibrate = variant.calibrate, contact = variant.contact, seed = s.seed,
    })
    for level = 1, 2 do
      count(level_name(variant.name, level), paper_variants.label(variant.name, level),
        chain[level])
    end
    s.save(("%s/%s-chain.glb"):format(folder, method_name(variant):lower()), chain)
    chains[variant.name] = chain
  end
  local count_columns = {"model", "nodes", "ends", "paper: nodes", "paper: ends"}
  s.csv(folder .. "/counts.csv", counts, {columns = count_columns})
  print()
  print(s.format_table(counts, {columns = count_columns}))
  return chains
end

-- 3. Run every level from the same starts.
local function run_levels(chains)
  local scene = s.scenario(dofile(samples .. "/throw_at_wall.lua"))
  local rows, columns, timings, timing_columns = {}, nil, {}, nil
  local series, compared = {}, {}
  local list, names = {}, {}
  for i, variant in ipairs(variants) do
    list[i], names[i] = chains[variant.name], method_name(variant)
  end
  local all = s.compare(list, scene,
    {starts = starts, jitter = 0.02, seed = s.seed, variants = names})
  for i, variant in ipairs(variants) do
    local runs = all[i]
    compared[variant.name] = runs
    local table_rows
    table_rows, columns = runs:table()
    local points = {}
    for _, row in ipairs(table_rows) do
      -- The base has run once for all of them.
      if row.level > 0 or i == 1 then rows[#rows + 1] = row end
      points[#points + 1] = {
        1 / row.cost_ratio, row.surface_error_percent, label = row.level > 0 and row.label or nil,
        clip = row.label,
      }
    end
    series[#series + 1] = {name = method_name(variant), points = points}
    local measured
    measured, timing_columns = runs:timings()
    for _, row in ipairs(measured) do
      if row.level > 0 or i == 1 then timings[#timings + 1] = row end
    end
  end
  s.csv(folder .. "/table.csv", rows, {columns = columns})
  s.csv(folder .. "/timings.csv", timings, {columns = timing_columns})
  print()
  comparison_table.print(rows, starts, chains[variants[1].name][0].bounds.diagonal)
  return {rows = rows, timings = timings, series = series, compared = compared}
end

-- 4. Cost and error of each level.
local chart = {
  title = "Two rods thrown at a wall: cost against error",
  x_label = "cost per simulated second (spring updates, base = 1)",
  y_label = "surface error (% of the body's diagonal)",
  log_x = true,
}

-- 5. The video: the base, level 2 of LOD-hb and the fitted level 2, synchronized.
local function make_video(compared)
  local frames, frame_rate = s.animate(folder .. "/frames", {compared.hb, compared.fit},
    {frames = frame_count, camera = "follow", levels = {0, 2}, height = 600})
  s.video(folder .. "/comparison.mp4", folder .. "/frames", {frame_rate = frame_rate})
  s.say(("%d frames, table.csv, counts.csv, chart.svg, comparison.mp4 and %d assets are in %s")
    :format(frames, #variants, folder))
end

-- 6. What the runs say, in three sentences.
local function second_level(rows, of)
  local found = {}
  for _, row in ipairs(rows) do
    if row.level == 2 and of(row) then found[#found + 1] = row end
  end
  return found
end

-- The smallest and the largest value of a column: "1.2 to 5.0".
local function range(of, column)
  local low, high = math.huge, -math.huge
  for _, row in ipairs(of) do
    low, high = math.min(low, row[column]), math.max(high, row[column])
  end
  return low == high and ("%.2g"):format(low) or ("%.2g to %.2g"):format(low, high)
end

-- Time of a simulated second [s].
local function time_of(timings, label)
  local wall, simulated = 0, 0
  for _, row in ipairs(timings) do
    if row.label == label then
      wall, simulated = wall + row.wall_seconds, simulated + row.simulated
    end
  end
  return wall / simulated
end

local function results(runs)
  local fit_label = level_name("fit", 2)
  local merged = second_level(runs.rows, function(row) return row.label ~= fit_label end)
  local fitted = second_level(runs.rows, function(row) return row.label == fit_label end)
  return {
    ("Merged as in the paper, level 2 needs %s times fewer spring updates than the base; its "
      .. "surface is %s %% of the body's size away from the base's."):format(
      range(merged, "cost_ratio"), range(merged, "surface_error_percent")),
    ("Fitted to the base, with contact at its surface, level 2 needs %s times fewer and is %s "
      .. "%% away."):format(range(fitted, "cost_ratio"), range(fitted, "surface_error_percent")),
    ("By the clock of this machine, a simulated second takes %s for the base and %s "
      .. "for the fitted level 2."):format(
      show.quantity(time_of(runs.timings, "base"), "time"),
      show.quantity(time_of(runs.timings, fit_label), "time", 2)),
  }
end

-- 7. One page with all of it.
local function write_page(runs, chains, sentences)
  local comparisons, names = {}, {}
  for i, variant in ipairs(variants) do
    comparisons[i] = runs.compared[variant.name]
    names[i] = method_name(variant)
  end
  page.write(folder .. "/index.html", {
    command = "demo", title = "Two rods, joined by rubber, thrown at a wall",
    verdict = sentences, line = command.line(),
    film = {path = folder .. "/comparison.mp4",
            panels = {"base", level_name("hb", 2), level_name("fit", 2)}},
    view = s.view(comparisons), chains = names, facts = page.facts(runs.rows),
    charts = {{runs.series, chart}},
    tables = {page.comparison_table(runs.rows)},
    provenance = page.provenance(chains.fit, {
      {"scenario", "samples/throw_at_wall.lua"}, {"starts", ("%d, jitter 0.02"):format(starts)}}),
  })
end

local ok, failure = command.try_in(folder, function()
  local chains = make_chains(make_base())
  local runs = run_levels(chains)
  command.chart(folder .. "/chart", runs.series, chart)
  make_video(runs.compared)
  local sentences = results(runs)
  write_page(runs, chains, sentences)
  print("\n" .. table.concat(sentences, "\n"))
  print("All of it on one page: " .. folder .. "/index.html")
end)
if not ok then command.fail("demo: %s", failure) end
