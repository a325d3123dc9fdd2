-- The numbers of the paper's tables, for comparison.

local paper_numbers = {}

-- Table 1: distance, difference from the base, nodes, ends of springs.
paper_numbers.roll = {
  base = {distance = 6.1, difference = 0, nodes = 281, ends = 4094},
  ["LOD-1"] = {distance = 4.5, difference = 1.6, nodes = 123, ends = 1762},
  ["LOD-b-1"] = {distance = 4.6, difference = 1.5, nodes = 121, ends = 1784},
  ["LOD-2"] = {distance = 5, difference = 1.1, nodes = 55, ends = 722},
  ["LOD-b-2"] = {distance = 4.5, difference = 1.6, nodes = 53, ends = 780},
  ["LOD-h-1"] = {distance = 5.6, difference = 0.5, nodes = 114, ends = 1596},
  ["LOD-hb-1"] = {distance = 5.6, difference = 0.5, nodes = 114, ends = 1596},
  ["LOD-h-2"] = {distance = 5.5, difference = 0.6, nodes = 51, ends = 670},
  ["LOD-hb-2"] = {distance = 6, difference = 0.1, nodes = 51, ends = 670},
}

-- Table 2: nodes and ends.
paper_numbers.rods = {
  base = {nodes = 368, ends = 4724},
  ["LOD-hb-1"] = {nodes = 154, ends = 1746},
  ["LOD-hb-2"] = {nodes = 67, ends = 658},
  ["LOD-b-1"] = {nodes = 154, ends = 1828},
  ["LOD-b-2"] = {nodes = 65, ends = 640},
}

-- Table 2: final distance from the wall and its +- for each speed, in the paper's units.
paper_numbers.speeds = {30, 31, 32, 33, 39, 40}
paper_numbers.wall = {
  base = {{6.0, 0.5}, {3.6, 0.2}, {4.4, 0.9}, {3.4, 1.0}, {6.8, 0.3}, {5.7, 0.3}},
  ["LOD-hb-1"] = {{6.0, 0.1}, {5.6, 0.1}, {5.2, 0.1}, {3.5, 0.1}, {6.4, 0.2}, {6.6, 0.1}},
  ["LOD-hb-2"] = {{4.6, 0.1}, {4.8, 0.1}, {4.0, 0.3}, {4.4, 0.1}, {4.1, 1.0}, {5.2, 0.1}},
  ["LOD-b-1"] = {{4.2, 0.1}, {2.7, 0.4}, {3.2, 0.1}, {4.0, 0.1}, {7.9, 0.5}, {9.1, 0.1}},
  ["LOD-b-2"] = {{5.6, 0.1}, {3.7, 0.1}, {4.7, 0.1}, {3.8, 0.1}, {4.0, 0.2}, {3.8, 0.1}},
}

-- The entry of Table 2 at a speed; nil if the paper has no such speed.
function paper_numbers.at(label, speed)
  for i, known in ipairs(paper_numbers.speeds) do
    if known == speed and paper_numbers.wall[label] then return paper_numbers.wall[label][i] end
  end
end

return paper_numbers
