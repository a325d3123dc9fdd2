-- An axisymmetric ball of radius 1 whose surface is plane up to an angle from the pole, as a plate
-- presses it, and which a body force balances.
local deck = require "calculix.deck"

local pressed_ball = {}

local inside = 0.01 -- radius of a hole, where elements would have no width

-- Increasing numbers, with their middles. Steps grow by a factor to at most `largest`.
local function graded(list, last, step, factor, largest)
  while list[#list] < last do
    step = math.min(step * factor, largest)
    local value = list[#list] + step
    list[#list + 1] = last - value < step / 2 and last or value
  end
  local all = {list[1]}
  for i = 2, #list do
    all[#all + 1] = (list[i - 1] + list[i]) / 2
    all[#all + 1] = list[i]
  end
  return all
end

-- Angles from the pole, and depths below the surface, of the nodes; fine near the contact.
local function places(angle)
  local across = 16 -- elements in the contact
  local angles = {}
  for i = 0, across do angles[i + 1] = angle * math.sin(math.pi / 2 * i / across) end
  local step = angles[across + 1] - angles[across]
  return graded(angles, math.pi, step, 1.25, 0.15),
         graded({0}, 1 - inside, angle / 12, 1.15, 0.12)
end

-- Places {x, z} of the nodes, elements of eight nodes, and the numbers of the nodes by place.
local function mesh_of(angles, depths)
  local nodes, elements, number_of = {}, {}, {}
  for i, depth in ipairs(depths) do
    number_of[i] = {}
    for j, angle in ipairs(angles) do
      if i % 2 == 1 or j % 2 == 1 then -- no node in the middle of an element
        local r = 1 - depth
        local on_axis = j == 1 or j == #angles
        nodes[#nodes + 1] = {on_axis and 0 or r * math.sin(angle), r * math.cos(angle)}
        number_of[i][j] = #nodes
      end
    end
  end
  -- Counter-clockwise: corners, then the middles that follow them.
  local around = {{2, 0}, {2, 2}, {0, 2}, {0, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 0}}
  for i = 1, #depths - 2, 2 do
    for j = 1, #angles - 2, 2 do
      local element = {}
      for n, step in ipairs(around) do element[n] = number_of[i + step[1]][j + step[2]] end
      elements[#elements + 1] = element
    end
  end
  return nodes, elements, number_of
end

-- Shape functions at a point of an element.
local corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}
local function shapes(x, y)
  local values = {}
  for i, c in ipairs(corners) do
    values[i] = (1 + c[1] * x) * (1 + c[2] * y) * (c[1] * x + c[2] * y - 1) / 4
  end
  values[5], values[7] = (1 - x * x) * (1 - y) / 2, (1 - x * x) * (1 + y) / 2
  values[6], values[8] = (1 + x) * (1 - y * y) / 2, (1 - x) * (1 - y * y) / 2
  return values
end

local function sum(values, weights)
  local total = 0
  for i, value in ipairs(values) do total = total + value * weights[i] end
  return total
end

-- Mean of values at the nodes over the volume, by Gauss's rule.
local function mean(nodes, elements, value_of)
  local points, step = {{-math.sqrt(0.6), 5 / 9}, {0, 8 / 9}, {math.sqrt(0.6), 5 / 9}}, 1e-5
  local total, volume = 0, 0
  for _, element in ipairs(elements) do
    local x, z, values = {}, {}, {}
    for i, node in ipairs(element) do
      x[i], z[i], values[i] = nodes[node][1], nodes[node][2], value_of[node]
    end
    for _, p in ipairs(points) do
      for _, q in ipairs(points) do
        local function slope(list, dx, dy)
          return (sum(list, shapes(p[1] + dx, q[1] + dy))
            - sum(list, shapes(p[1] - dx, q[1] - dy))) / (2 * step)
        end
        local area = slope(x, step, 0) * slope(z, 0, step) - slope(x, 0, step) * slope(z, step, 0)
        local here = shapes(p[1], q[1])
        local weight = math.abs(area) * sum(x, here) * p[2] * q[2]
        volume, total = volume + weight, total + weight * sum(values, here)
      end
    end
  end
  return total / volume
end

-- The depth of the centre of mass under a force, over young * radius^2, with the contact up to an
-- angle. `material`: lines of a deck for E = 1; `large`: at large strain.
function pressed_ball.depth(folder, name, angle, force, material, large)
  local angles, depths = places(angle)
  local nodes, elements, number_of = mesh_of(angles, depths)
  local lines = {"*NODE, NSET=ALL"}
  for number, x in ipairs(nodes) do
    lines[#lines + 1] = ("%d, %.12g, %.12g, 0"):format(number, x[1], x[2])
  end
  lines[#lines + 1] = "*ELEMENT, TYPE=CAX8, ELSET=BALL"
  for number, element in ipairs(elements) do
    lines[#lines + 1] = number .. ", " .. table.concat(element, ", ")
  end
  lines[#lines + 1] = "*MATERIAL, NAME=M\n" .. material .. "\n*DENSITY\n1\n"
    .. "*SOLID SECTION, ELSET=BALL, MATERIAL=M\n*BOUNDARY"
  for i = 1, #depths do
    for _, j in ipairs{1, #angles} do
      if number_of[i][j] then lines[#lines + 1] = number_of[i][j] .. ", 1, 1" end
    end
  end
  lines[#lines + 1] = large and "*STEP, NLGEOM, INC=100\n*STATIC\n1, 1\n*BOUNDARY"
    or "*STEP\n*STATIC\n*BOUNDARY"
  for j, at in ipairs(angles) do
    if at > angle * (1 + 1e-9) then break end
    lines[#lines + 1] = ("%d, 2, 2, %.12g"):format(number_of[1][j], 1 - math.cos(at))
  end
  lines[#lines + 1] = ("*DLOAD\nBALL, GRAV, %.12g, 0, 1, 0\n*NODE PRINT, NSET=ALL\nU\n*END STEP")
    :format(force / (4 / 3 * math.pi))
  local moved = {}
  for line in deck.results(folder, name, lines) do
    local number, value = line:match("^%s*(%d+)%s+%S+%s+(%S+)%s+%S+%s*$")
    if number then moved[tonumber(number)] = tonumber(value) end
  end
  return mean(nodes, elements, moved)
end

return pressed_ball
