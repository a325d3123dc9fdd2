-- Run the levels of an asset side by side: table, chart, frames, video.

local s = require "springlod"
local command = require "lib.command"
local conversion = require "lib.conversion"
local fit_store = require "lib.fit_store"
local simplify_options = require "lib.simplify_options"

local parser = command.parser("compare", "Run every level of an asset under one scenario. "
  .. "Writes table.csv, starts.csv, chart.svg, chart.png, frames/frame_0000.png ..., "
  .. "comparison.mp4 and timings.csv (wall-clock times, the only output that varies between runs). "
  .. "With options of levels, such as --grouping standard, the levels are made anew from the base "
  .. "of the asset; those that are not given are as convert has them.")
parser:argument("asset", "a .glb asset, written by convert or s.save")
parser:option("--scenario", "Lua file that returns a table for s.scenario; it may also have "
  .. "anchored: what holds nodes of the base, as for s.compare")
  :argname("<file.lua>"):count(1)
parser:option("--out", "folder to write to"):argname("<folder>"):count(1)
parser:option("--starts", "number of starts; every level uses the same ones")
  :convert(command.whole("--starts", 1)):default("1")
parser:option("--jitter", "relative variation of speed and height between starts (default: 0.02)")
  :convert(command.number("--jitter", 0, true))
parser:option("--variant", "name used in labels: hb gives LOD-hb-1")
parser:option("--frames", "maximum number of frames; 0 writes none")
  :convert(command.whole("--frames", 0)):default("300")
parser:option("--frame-rate", "frames per second of the video")
  :convert(command.number("--frame-rate", 0)):default("30")
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

-- The levels of the asset, or others of its base.
local function levels_of(asset)
  if not options then return asset end
  if fits then
    conversion.announce_fit(asset[0])
    options.calibration = options.calibration or {}
    options.calibration.store = fit_folder
  end
  return s.simplify(asset[0], options)
end

local function animate(runs)
  local folder = args.out .. "/frames"
  s.animate(folder, runs, {
    width = args.width, height = args.height, frames = args.frames,
    frame_rate = args.frame_rate, slow = args.slow, camera = args.camera,
    springs = args.springs, surface_opacity = args.springs and 0.35 or nil,
  })
  s.video(args.out .. "/" .. args.video, folder, {frame_rate = args.frame_rate})
end

local function compare()
  local chain = levels_of(s.load(args.asset))
  local scene = command.load_table(args.scenario)
  local anchored = scene.anchored
  scene.anchored = nil
  local runs = s.compare(chain, scene, {
    starts = args.starts, jitter = args.jitter, seed = s.seed, threads = s.threads,
    variant = args.variant, frame_rate = args.frame_rate * args.slow, contact = args.contact,
    anchored = anchored,
  })
  local rows, columns = runs:table()
  s.csv(args.out .. "/table.csv", rows, {columns = columns})
  local starts, start_columns = runs:starts()
  s.csv(args.out .. "/starts.csv", starts, {columns = start_columns})
  local times, time_columns = runs:timings()
  s.csv(args.out .. "/timings.csv", times, {columns = time_columns})
  command.chart(args.out .. "/chart", runs)
  if args.frames > 0 then animate(runs) end
  fit_store.remove(fit_folder)
  return rows
end

local function short_rows(rows)
  local short = {}
  for i, row in ipairs(rows) do
    short[i] = {row.label, row.nodes, row.ends, ("%.3g"):format(row.step), row.limited_by,
                ("%.2f"):format(row.cost_ratio), ("%.2f"):format(row.surface_error_percent),
                ("%.2f"):format(row.shape_error_percent), ("%.4f"):format(row.distance)}
  end
  return short
end

local ok, rows = command.try_in(args.out, compare, fits)
if not ok then command.fail("cannot compare %s: %s", args.asset, rows) end
print(s.format_table(short_rows(rows), {columns = {
  "level", "nodes", "ends", "step [s]", "limited by", "cost ratio", "surface error [%]",
  "shape error [%]", "distance [m]"}}))
s.say("wrote " .. args.out)
