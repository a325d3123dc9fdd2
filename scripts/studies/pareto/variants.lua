-- The variants of springlod pareto: simplification methods, ways to run them (integrator, precision
-- and contact), and names.

local s = require "springlod"
local paper_variants = require "studies.paper.variants"

local pareto_variants = {}

-- All values of each axis.
pareto_variants.axes = {
  groupings = s.choices.grouping,
  borders = s.choices.border,
  calibrations = s.choices.calibrate,
  integrators = s.choices.integrator,
  precisions = s.choices.precision,
  contacts = s.choices.contact,
  errors = {"frequencies", "loads", "surface", "ensemble"},
}

local paper_groupings = {standard = true, priority = true}

local short = { -- names in chart labels
  priority_hard = "hard", velocity_verlet = "Verlet", runge_kutta_4 = "RK4",
  backward_euler_cg = "BE", backward_euler_direct = "BE direct", xpbd = "XPBD",
  projective_dynamics = "PD",
}

-- The simplification methods; the first is the base itself, which has no grouping.
function pareto_variants.methods(axes)
  local methods = {{name = "base"}}
  for _, grouping in ipairs(axes.groupings) do
    for _, border in ipairs(axes.borders) do
      for _, calibration in ipairs(axes.calibrations) do
        if border == "none" or s.choices.grouping[grouping].follows_border then
          methods[#methods + 1] = {
            name = ("%s-%s-%s"):format(grouping, border, calibration), grouping = grouping,
            border = border, calibration = calibration,
          }
        end
      end
    end
  end
  return methods
end

-- The ways to run the levels of a method: integrators, each with the precisions that it supports,
-- and what touches obstacles. That is always the nodes of the base itself.
function pareto_variants.steppings(axes, making)
  local steppings = {}
  local function add(integrator, precision, contact)
    steppings[#steppings + 1] = {
      name = ("%s-%s-%s"):format(integrator, precision, contact), integrator = integrator,
      precision = precision, contact = contact,
      usual = integrator == "symplectic_euler" and precision == "double" and contact == "nodes",
    }
  end
  for _, integrator in ipairs(axes.integrators) do
    for _, precision in ipairs(axes.precisions) do
      if precision == "double" or s.choices.integrator[integrator].fast then
        for _, contact in ipairs(making.grouping and axes.contacts or {"nodes"}) do
          add(integrator, precision, contact)
        end
      end
    end
  end
  return steppings
end

-- "compact weak modes L1 RK4"; default choices are omitted.
local function label(making, level, stepping)
  local words = {}
  local function add(word) words[#words + 1] = short[word] or word end
  if making.grouping then
    add(making.grouping)
    if making.border ~= "none" then add(making.border) end
    if making.calibration ~= "none" then add(making.calibration) end
    add("L" .. level)
  else
    add("base")
  end
  if stepping.integrator ~= "symplectic_euler" then add(stepping.integrator) end
  if stepping.precision == "single" then add("single") end
  if stepping.contact == "surface" then add("surface") end
  return table.concat(words, " ")
end

-- The paper's name of a level, "LOD-hb-1", or ours if the paper has none; nil if the method is not
-- the paper's.
local function paper_name(making, level, stepping)
  if not (paper_groupings[making.grouping] and making.calibration == "none" and stepping.usual) then
    return nil
  end
  for _, variant in ipairs(paper_variants) do
    if variant.grouping == making.grouping and variant.border == making.border then
      return paper_variants.label(variant.name, level)
    end
  end
  return label(making, level, stepping)
end

-- One level of one method with one integrator; `step_options` are options of s.run.
function pareto_variants.variant(making, level, stepping, implicit_step)
  return {
    name = making.grouping and ("%s-%d-%s"):format(making.name, level, stepping.name)
      or "base-" .. stepping.name,
    label = label(making, level, stepping), paper = paper_name(making, level, stepping),
    making = making, level = level, stepping = stepping,
    step_options = {
      integrator = stepping.integrator, precision = stepping.precision,
      contact = stepping.contact,
      step = s.choices.integrator[stepping.integrator].implicit and implicit_step or nil,
    },
  }
end

return pareto_variants
