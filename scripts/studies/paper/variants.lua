-- The simplification variants of the paper and their names (b = weak border, h = priority grouping,
-- number = level), and our calibrated variants.

local paper_variants = {
  {name = "", grouping = "standard", border = "none"},
  {name = "b", grouping = "standard", border = "weak"},
  {name = "h", grouping = "priority", border = "none"},
  {name = "hb", grouping = "priority", border = "weak"},
}

-- Calibrated levels of the paper's groups and of compact groups, with about as many nodes as the
-- paper's levels. Weak borders (b) keep the contact nodes near the surface; s: contact on the
-- surface of the base; p: the second moments of each material region are preserved too.
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

-- "LOD", "LOD-b", ...: the labels of the paper's variants, and of all variants.
function paper_variants.paper_labels() return labels_of(paper_variants) end
function paper_variants.labels() return labels_of(with_calibrated(paper_variants)) end

-- Those of `variants` and of the calibrated variants whose labels are in `settings.variants`.
function paper_variants.wanted(variants, settings)
  local requested, wanted = {}, {}
  for _, label in ipairs(settings.variants) do requested[label] = true end
  for _, variant in ipairs(with_calibrated(variants)) do
    if requested[paper_variants.label(variant.name)] then wanted[#wanted + 1] = variant end
  end
  return wanted
end

-- The label of a level of a variant: "base", "LOD-1", "LOD-hb-2". Without `level` the label of the
-- variant: "LOD-hb".
function paper_variants.label(name, level)
  if level == 0 then return "base" end
  local all = name == "" and "LOD" or "LOD-" .. name
  return level and all .. "-" .. level or all
end

return paper_variants
