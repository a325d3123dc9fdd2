-- The problems of the validation, in the order of the page. Each has
--   name, title, text, source    words for the page
--   size_name, sizes, quick      what a size counts, and sizes; the last one is judged
--   quantities                   list of {name, reference, goal, level_goals}: goals in percent; if
--                                the reference is 0, a largest value
--   body(size)                   the base
--   fitted                       whether its fitted levels are measured too
--   measure(model, size)         list of values, false for what the model does not show

local problems = {}
for i, name in ipairs{"cube", "sphere", "cantilever", "bar", "sliding", "spin"} do
  problems[i] = require("studies.validate." .. name)
end
return problems
