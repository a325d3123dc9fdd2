-- The paper's ways of merging and its names for them: b = weak border, h = priority, number =
-- level.

local paper_variants = {
  {name = "", grouping = "standard", border = "none"},
  {name = "b", grouping = "standard", border = "weak"},
  {name = "h", grouping = "priority", border = "none"},
  {name = "hb", grouping = "priority", border = "weak"},
}

-- "base", "LOD-1", "LOD-hb-2" of the variant's name and the level; without one that of all levels,
-- "LOD-hb".
function paper_variants.label(name, level)
  if level == 0 then return "base" end
  local all = name == "" and "LOD" or "LOD-" .. name
  return level and all .. "-" .. level or all
end

return paper_variants
