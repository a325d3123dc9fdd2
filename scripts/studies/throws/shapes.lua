-- Random shapes. Each entry draws one of about `cells` cells: a table of its name, size (cells
-- along the axes), inside(x, y, z), and, if the shape prescribes the stiff part, stiff(x, y, z).
-- Both functions take the centre of a cell in cells from the centre of the box of `size`.

local random = require "studies.throws.random"

local function everywhere() return true end

local function rounded(x, least) return math.max(least, math.floor(x + 0.5)) end

-- Edges of a box of `volume`, with ratios of up to e.
local function edges(volume, count)
  local list, product = {}, 1
  for i = 1, count do
    list[i] = math.exp(random.uniform(-0.5, 0.5))
    product = product * list[i]
  end
  for i = 1, count do list[i] = rounded(list[i] * (volume / product) ^ (1 / count), 3) end
  return list
end

local function box(cells)
  return {name = "box", size = edges(cells, 3), inside = everywhere}
end

local function bar(cells)
  local width, height = random.whole(3, 5), random.whole(3, 5)
  return {name = "bar", inside = everywhere,
          size = {width, height, rounded(cells / (width * height), 5)}}
end

local function plate(cells)
  local thickness = random.whole(2, 3)
  local sides = edges(cells / thickness, 2)
  return {name = "plate", size = {sides[1], sides[2], thickness}, inside = everywhere}
end

local function ball(cells)
  local radius = (cells * 3 / (4 * math.pi)) ^ (1 / 3)
  local edge = 2 * math.ceil(radius)
  return {name = "ball", size = {edge, edge, edge}, inside = function(x, y, z)
    return x * x + y * y + z * z <= radius * radius
  end}
end

-- An L or a U: `arms` arms of one width along the sides of a square, which is empty otherwise.
local function bent(name, arms, low, high)
  return function(cells)
    local share, flatness = random.uniform(low, high), random.uniform(0.7, 1.3)
    local filled = 1 - (1 - (arms - 1) * share) * (1 - share)
    local side = (cells / (filled * share * flatness)) ^ (1 / 3)
    local edge, width = rounded(side, 5), rounded(share * side, 2)
    return {name = name, size = {edge, edge, rounded(share * flatness * side, 2)},
            inside = function(x, y)
      return math.min(x, y) < width - edge / 2 or arms == 3 and x > edge / 2 - width
    end}
  end
end

-- Two stiff rods, joined by a soft middle.
local function rods(cells)
  local width = random.whole(3, 4)
  local length = rounded(cells / width ^ 2, 12)
  local joint = random.uniform(0.15, 0.35) * length
  return {name = "rods", size = {width, width, length}, inside = everywhere,
          stiff = function(_, _, z) return math.abs(z) > joint / 2 end}
end

-- A union of balls, each with its centre on the surface of an earlier one.
local function blob(cells)
  local balls = {{0, 0, 0, radius = 1}}
  for i = 2, random.whole(3, 5) do
    local from, direction = balls[random.whole(1, i - 1)], random.direction()
    balls[i] = {radius = random.uniform(0.6, 1)}
    for axis = 1, 3 do balls[i][axis] = from[axis] + from.radius * direction[axis] end
  end
  local low, high = {}, {}
  for axis = 1, 3 do
    low[axis], high[axis] = math.huge, -math.huge
    for _, one in ipairs(balls) do
      low[axis] = math.min(low[axis], one[axis] - one.radius)
      high[axis] = math.max(high[axis], one[axis] + one.radius)
    end
  end
  -- The blob with `scale` cells in the unit of the balls.
  local function scaled(scale)
    local size = {}
    for axis = 1, 3 do size[axis] = math.ceil(scale * (high[axis] - low[axis])) end
    return size, function(...)
      for _, one in ipairs(balls) do
        local square = 0
        for axis = 1, 3 do
          local x = select(axis, ...) / scale + (low[axis] + high[axis]) / 2
          square = square + (x - one[axis]) ^ 2
        end
        if square <= one.radius ^ 2 then return true end
      end
      return false
    end
  end
  local coarse, filled = 5, 0 -- counts the cells at a first scale
  local size, inside = scaled(coarse)
  for x = 1, size[1] do
    for y = 1, size[2] do
      for z = 1, size[3] do
        if inside(x - (size[1] + 1) / 2, y - (size[2] + 1) / 2, z - (size[3] + 1) / 2) then
          filled = filled + 1
        end
      end
    end
  end
  size, inside = scaled(coarse * (cells / filled) ^ (1 / 3))
  return {name = "blob", size = size, inside = inside}
end

return {box, bar, plate, ball, bent("L", 2, 0.25, 0.45), bent("U", 3, 0.2, 0.3), rods, blob}
