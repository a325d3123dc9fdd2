-- Redraw the figures of the paper from newly built bodies, levels and runs.

local s = require "springlod"
local command = require "lib.command"
local paper_figures = require "studies.paper.figures"

local parser = command.parser("figures", "Redraw the figures of Kot, Nagahashi and Gracki, "
  .. "\"Simplification of mass spring models\", as figure-1.png to figure-8.png, and Young's "
  .. "modulus and density of every node by their eq. 2 as figure-e-density-*.png.")
command.add_out(parser, "out/figures", "folder", true)
parser:flag("--quick", "draw smaller pictures")
local args = parser:parse()

local ok, drawn = command.try_in(args.folder, function()
  return paper_figures.draw(args.folder, {seed = s.seed, quick = args.quick})
end)
if not ok then command.fail("figures: %s", drawn) end
for _, figure in ipairs(drawn) do
  print(("%s/%s: %s"):format(args.folder, figure.file, figure.title))
end
