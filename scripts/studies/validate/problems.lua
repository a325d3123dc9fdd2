-- The problems of the validation, in the order of the page. Each has
--   name, title, text, source    words for the page; notes: more after the table, if there are any
--   size_name, sizes, quick      what a size counts, and sizes; the last one is judged
--   quantities                   list of {name, reference, goal, level_goals}: goals in percent; if
--                                the reference is 0, a largest value
--   body(size)                   the base; problems with the same function share the levels, too
--   fitted                       whether its fitted levels are measured too
--   fitted_modes                 frequencies that they are fitted to, if not as many as by default
--   anchored(size)               what holds the base, if anything, for the fit of its levels
--   measure(model, size, level)  list of values, false for what the model does not show; `level`
--                                has base: the model of level 0; carried(nodes): the nodes of the
--                                level that carry nodes of the base; group_of(node): the one that
--                                carries that node; to_base(values): see chain:to_base

local problems = {}
local files = {"stretch", "cube", "sphere", "rayleigh", "cantilever",
               "elastica", "silicone", "plates", "two_materials", "bar", "hertz", "bounce",
               "sliding", "spin"}
for _, name in ipairs(files) do
  local found = require("studies.validate." .. name)
  -- A file may have several.
  for _, problem in ipairs(found.name and {found} or found) do problems[#problems + 1] = problem end
end
return problems
