-- Draws the figures of the paper with bodies, levels and runs made here:
--
--   springlod run scripts/figures.lua -- [FOLDER [quick]]

local s = require "springlod"
local figures = require "lib.paper_figures"

local folder = arg[1] or "out/figures"
for _, drawn in ipairs(figures.draw(folder, {seed = s.seed, quick = arg[2] == "quick"})) do
  print(("%s/%s: %s"):format(folder, drawn.file, drawn.title))
end
