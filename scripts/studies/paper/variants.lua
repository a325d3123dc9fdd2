-- The paper's ways of merging and its names for them: b = weak border, h = priority, number =
-- level. Besides, ways of ours: levels fitted to the base.

local paper_variants = {
  {name = "", grouping = "standard", border = "none"},
  {name = "b", grouping = "standard", border = "weak"},
  {name = "h", grouping = "priority", border = "none"},
  {name = "hb", grouping = "priority", border = "weak"},
}

-- The paper's groups and compact ones, fitted. With weak borders, for what touches floor and wall
-- then stays where the surface was, or (s) touching at the base's surface itself, or so and (p)
-- with the moments of pieces of one material kept; about as many nodes as the paper's levels.
paper_variants.calibrated = {
  {name = "fit-b", grouping = "standard", border = "weak", calibrate = "modes",
   keep = {0.45, 0.2}},
  {name = "fit-compact-b", grouping = "compact", border = "weak", calibrate = "modes",
   keep = {0.45, 0.2}},
  {name = "fit-compact-s", grouping = "compact", border = "none", calibrate = "modes",
   keep = {0.45, 0.2}, contact = "surface"},
  {name = "fit-compact-sp", grouping = "compact", border = "none", calibrate = "modes",
   keep = {0.45, 0.2}, contact = "surface", moments = "pieces"},
}

local function with_calibrated(variants)
  local all = table.move(variants, 1, #variants, 1, {})
  return table.move(paper_variants.calibrated, 1, #paper_variants.calibrated, #all + 1, all)
end

local function labels_of(variants)
  local labels = {}
  for i, variant in ipairs(variants) do labels[i] = paper_variants.label(variant.name) end
  return labels
end

-- "LOD", "LOD-b", ... of the paper's variants, and of all.
function paper_variants.paper_labels() return labels_of(paper_variants) end
function paper_variants.labels() return labels_of(with_calibrated(paper_variants)) end

-- Of `variants` and the calibrated ones those whose labels `settings.variants` lists.
function paper_variants.wanted(variants, settings)
  local asked, wanted = {}, {}
  for _, label in ipairs(settings.variants) do asked[label] = true end
  for _, variant in ipairs(with_calibrated(variants)) do
    if asked[paper_variants.label(variant.name)] then wanted[#wanted + 1] = variant end
  end
  return wanted
end

-- "base", "LOD-1", "LOD-hb-2" of the variant's name and the level; without one that of all levels,
-- "LOD-hb".
function paper_variants.label(name, level)
  if level == 0 then return "base" end
  local all = name == "" and "LOD" or "LOD-" .. name
  return level and all .. "-" .. level or all
end

return paper_variants
