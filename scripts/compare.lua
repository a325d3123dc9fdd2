-- Run the levels of an asset side by side: table, chart, frames, video.

local s = require "springlod"
local certificates = require "lib.certificates"
local command = require "lib.command"
local comparison_table = require "lib.comparison_table"
local conversion = require "lib.conversion"
local fit_store = require "lib.fit_store"
local page = require "lib.page"
local simplify_options = require "lib.simplify_options"

local film = {frames = 100, frame_rate = 30}

local parser = command.parser("compare", "Run every level of an asset under one scenario. "
  .. "Writes index.html (a page with all of it), table.csv, starts.csv, chart.svg, chart.png, "
  .. "frames/frame_0000.png ..., "
  .. "comparison.mp4 and timings.csv (wall-clock times, the only output that varies between runs). "
  .. "Several assets share one table, chart and video, which has the base of the first one. "
  .. "With options of levels, such as --grouping standard, the levels are made anew from the base "
  .. "of the asset; those that are not given are as convert has them.")
parser:argument("asset", "a .glb asset, written by convert or s.save"):args("+")
parser:option("--scenario", "Lua file that returns a table for s.scenario; it may also have "
  .. "anchored: what holds nodes of the base, as for s.compare")
  :argname("<file.lua>"):count(1)
command.add_out(parser, "out/compare")
parser:option("--starts", "number of starts; every level uses the same ones; a body "
  .. "without speed and obstacles is run from one")
  :convert(command.whole("--starts", 1)):default("8")
parser:option("--jitter", "relative variation of speed and height between starts (default: 0.02)")
  :convert(command.number("--jitter", 0, true))
parser:option("--variant", "name used in labels: hb gives \"hb level 1\" (default: none; of "
  .. "several assets, their names)")
parser:option("--frames", "maximum number of frames; 0 draws none")
  :convert(command.whole("--frames", 0)):default(tostring(film.frames))
parser:option("--frame-rate", ("frames per second of the video, which ends after --frames "
  .. "(default: %d, or less so that --frames show all of the run)"):format(film.frame_rate))
  :convert(command.number("--frame-rate", 0))
parser:option("--slow", "slow motion: 4 plays four times slower than real time")
  :convert(command.number("--slow", 0)):default("1")
parser:option("--width", "width of one panel in pixels")
  :convert(command.whole("--width", 1)):default("640")
parser:option("--height", "height of one panel in pixels")
  :convert(command.whole("--height", 1)):default("480")
parser:option("--camera", "fixed camera, or one that follows the body")
  :choices(s.choices.camera):default("fixed")
parser:option("--video", "file name of the video, .mp4 or .gif"):default("comparison.mp4")
parser:flag("--springs", "draw the springs under a transparent surface")
simplify_options.add(parser, conversion.presets.best.simplify)
local args = parser:parse()

local fit_folder = args.out .. "/unfinished"

-- The options of levels that are made anew, or nil. --contact alone changes the runs only.
local function options_of_levels()
  local given = simplify_options.given(args)
  if #given == 0 or #given == 1 and args.contact then return nil end
  return simplify_options.read(args, conversion.presets.best.simplify)
end

local options = options_of_levels()
local fits = options ~= nil and options.calibrate == "modes"

local assets = args.asset

-- The levels of an asset, or others of its base.
local function levels_of(number)
  local asset = s.load(assets[number])
  if not options then return asset end
  if fits then
    conversion.announce_fit(asset[0])
    options.calibration = options.calibration or {}
    options.calibration.store = #assets == 1 and fit_folder or fit_folder .. "/" .. number
  end
  return s.simplify(asset[0], options)
end

-- Names of the assets in labels; those of the same name are numbered.
local function variants()
  if #assets == 1 then return {args.variant} end
  local names, uses = {}, {}
  for i, asset in ipairs(assets) do
    local name = (args.variant and args.variant .. "-" or "") .. command.stem(asset)
    uses[name] = (uses[name] or 0) + 1
    names[i] = uses[name] == 1 and name or ("%s-%d"):format(name, uses[name])
  end
  return names
end

local function animate(compared)
  local folder = args.out .. "/frames"
  local _, frame_rate = s.animate(folder, compared, {
    width = args.width, height = args.height, frames = args.frames,
    frame_rate = args.frame_rate, slow = args.slow, camera = args.camera,
    springs = args.springs, surface_opacity = args.springs and 0.35 or nil,
  })
  s.video(args.out .. "/" .. args.video, folder, {frame_rate = frame_rate})
end

-- The rows of all comparisons under one another, in a CSV file. With several, bases are told apart
-- by the names of their assets.
local function save_rows(file, compared, names, rows_of)
  local all, columns = {}, nil
  for i, runs in ipairs(compared) do
    local rows
    rows, columns = rows_of(runs)
    for _, row in ipairs(rows) do
      if #compared > 1 and row.level == 0 then row.label = names[i] .. " base" end
      all[#all + 1] = row
    end
  end
  s.csv(args.out .. "/" .. file, all, {columns = columns})
  return all
end

-- The panels of the film: the base of the first asset and the levels of all.
local function panels_of(compared)
  local panels = {}
  for i, runs in ipairs(compared) do
    for n, label in ipairs(runs.labels) do
      if i == 1 or n > 1 then panels[#panels + 1] = label end
    end
  end
  return panels
end

local function origin_of(chain, count)
  local entries = {}
  for _, path in ipairs(assets) do
    entries[#entries + 1] = {"asset", ("%s (hash %s)"):format(path, s.hash{file = path})}
  end
  entries[#entries + 1] = {"scenario", ("%s (hash %s)"):format(args.scenario,
    s.hash{file = args.scenario})}
  entries[#entries + 1] = {"starts", ("%d, jitter %g"):format(count, args.jitter or 0.02)}
  return page.provenance(chain, entries)
end

-- A sentence that the body touches nothing, or nil.
local function untouched_of(compared)
  for _, runs in ipairs(compared) do
    if runs.no_contact then return "Warning: " .. runs.no_contact .. "." end
  end
end

-- What the page says first. `starts`: the rows of starts.csv.
local function verdict_of(rows, starts, untouched)
  local sentences, inverted, at_end = page.comparison_verdict(rows), 0, 0
  if untouched then table.insert(sentences, 1, untouched) end
  for _, row in ipairs(starts) do
    if row.most_inverted > 0 then inverted = inverted + 1 end
    if row.inverted_at_end > 0 then at_end = at_end + 1 end
  end
  if inverted > 0 then
    sentences[#sentences + 1] = ("In %d of %d runs the body was inside out somewhere, in %d until "
      .. "the end; starts.csv lists them."):format(inverted, #starts, at_end)
  end
  return sentences
end

local function write_page(chain, scene_name, compared, names, rows, starts, untouched)
  -- Bodies with different bases have no view in common: then it is that of the first asset.
  local together, view = command.try(s.view, compared)
  if not together then view = s.view(compared[1]) end
  page.write(args.out .. "/index.html", {
    command = "compare", title = ("%s: %s"):format(command.stem(assets[1]), scene_name),
    verdict = verdict_of(rows, starts, untouched), line = command.line(),
    film = args.frames > 0 and args.video:find("%.mp4$")
      and {path = args.out .. "/" .. args.video, panels = panels_of(compared)} or nil,
    view = view, chains = together and #assets > 1 and names or nil, facts = page.facts(rows),
    charts = {page.cost_error(rows)}, tables = {page.comparison_table(rows)},
    provenance = origin_of(chain, starts[#starts].start),
  })
end

local function compare()
  local scene = command.load_table(args.scenario)
  local anchored = scene.anchored
  scene.anchored = nil
  local name = scene.name or command.stem(args.scenario)
  scene = s.scenario(scene)
  local compared, names, chain = {}, variants(), nil
  for i = 1, #assets do
    local levels = levels_of(i)
    chain = chain or levels
    certificates.warn_of_faults(levels, assets[i])
    compared[i] = s.compare(levels, scene, {
      starts = args.starts, jitter = args.jitter, seed = s.seed, threads = s.threads,
      variant = names[i], frame_rate = (args.frame_rate or film.frame_rate) * args.slow,
      contact = args.contact, anchored = anchored,
    })
  end
  local rows = save_rows("table.csv", compared, names, function(runs) return runs:table() end)
  local starts = save_rows("starts.csv", compared, names, function(runs) return runs:starts() end)
  save_rows("timings.csv", compared, names, function(runs) return runs:timings() end)
  command.chart(args.out .. "/chart", compared)
  if args.frames > 0 then animate(compared) end
  local untouched = untouched_of(compared)
  write_page(chain, name, compared, names, rows, starts, untouched)
  for i = 1, #assets do fit_store.remove(fit_folder .. (#assets == 1 and "" or "/" .. i)) end
  if #assets > 1 then os.remove(fit_folder) end
  return {rows = rows, starts = starts[#starts].start, untouched = untouched,
          size = chain[0].bounds.diagonal}
end

local ok, done = command.try_in(args.out, compare, fits)
if not ok then command.fail("cannot compare %s: %s", table.concat(assets, ", "), done) end
comparison_table.print(done.rows, done.starts, done.size)
if done.untouched then print(done.untouched) end
s.say("wrote " .. args.out .. "/index.html and what it shows")
