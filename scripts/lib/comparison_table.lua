-- The table of a comparison of levels for people, and what its columns mean.

local s = require "springlod"
local show = require "lib.show"

local comparison_table = {}

local columns = {"level", "nodes", "springs", "step", "limited by", "cost ratio", "surface error",
                 "shape error", "distance", "spread"}

-- `rows`: those of Comparison:table, of one or more comparisons; means over `starts` starts.
-- `size`: of the body [m]; what is below a millionth of it comes from rounding and is shown as 0.
function comparison_table.print(rows, starts, size)
  local function length(value, digits)
    return show.measured(math.abs(value) < 1e-6 * size and 0 or value, "length", digits)
  end
  local lines = {}
  for i, row in ipairs(rows) do
    lines[i] = {
      row.label, row.nodes, row.springs, show.measured(row.step, "time"), row.limited_by,
      show.full(row.cost_ratio), show.percent(row.surface_error_percent / 100),
      show.percent(row.shape_error_percent / 100), length(row.distance),
      starts > 1 and length(row.distance_spread, 2) or "-",
    }
  end
  print(s.format_table(lines, {columns = columns}))
  print(([[
Means over %d start%s. cost ratio: spring updates of the base over those of the level, for the same
simulated time. step: the time step, by default 0.8 of the stable step. surface error: distance of
the surface from the base's, until shortly after the first contact; shape error: the same without
shift and rotation, over the whole run; both in percent of the base's bounding diagonal. distance:
how far the body went (or from the obstacle measure_from of the scenario), and its spread over the
starts.]]):format(starts, starts == 1 and "" or "s"))
end

return comparison_table
