-- The frequency of a vibration A cos(w t) + B sin(w t) + C, by least squares.

local vibration = {}

-- Solves matrix x = right by elimination with pivots; changes both.
local function solve(matrix, right)
  local n = #right
  for column = 1, n do
    local pivot = column
    for row = column + 1, n do
      if math.abs(matrix[row][column]) > math.abs(matrix[pivot][column]) then pivot = row end
    end
    matrix[column], matrix[pivot] = matrix[pivot], matrix[column]
    right[column], right[pivot] = right[pivot], right[column]
    for row = column + 1, n do
      local factor = matrix[row][column] / matrix[column][column]
      for k = column, n do matrix[row][k] = matrix[row][k] - factor * matrix[column][k] end
      right[row] = right[row] - factor * right[column]
    end
  end
  for row = n, 1, -1 do
    for k = row + 1, n do right[row] = right[row] - matrix[row][k] * right[k] end
    right[row] = right[row] / matrix[row][row]
  end
  return right
end

-- What the value at time t is by a fit, and how it changes with cosine, sine, offset and frequency.
-- The frequency turns the phase about the middle of the times, which keeps the four apart.
local function value_and_slopes(fit, t)
  local phase = 2 * math.pi * fit.frequency * (t - fit.middle)
  local c, s = math.cos(phase), math.sin(phase)
  local turn = 2 * math.pi * (t - fit.middle)
  return fit.cosine * c + fit.sine * s + fit.offset,
    {c, s, 1, turn * (fit.sine * c - fit.cosine * s)}
end

-- The normal equations of the slopes, with the values' rest as right side, and that rest.
local function normal_equations(fit, times, values)
  local matrix = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}
  local right, rest = {0, 0, 0, 0}, {}
  for i, t in ipairs(times) do
    local value, slopes = value_and_slopes(fit, t)
    rest[i] = values[i] - value
    for j = 1, 4 do
      right[j] = right[j] + slopes[j] * rest[i]
      for k = 1, 4 do matrix[j][k] = matrix[j][k] + slopes[j] * slopes[k] end
    end
  end
  return matrix, right, rest
end

-- The fit of values at times [s], from a frequency [Hz] good to a small part of a turn over all:
-- frequency, and rest (what the fit leaves of each value).
function vibration.fit(times, values, frequency)
  local fit = {frequency = frequency, middle = (times[1] + times[#times]) / 2,
    cosine = 0, sine = 0, offset = 0}
  local last = math.huge
  for turn = 1, 50 do -- Gauss and Newton's; a handful are enough
    local matrix, right, rest = normal_equations(fit, times, values)
    fit.rest = rest
    if turn == 1 then -- amplitude unknown: nothing tells the frequency yet
      matrix[4], right[4] = {0, 0, 0, 1}, 0
      for j = 1, 3 do matrix[j][4] = 0 end
    end
    local change = solve(matrix, right)
    fit.cosine, fit.sine = fit.cosine + change[1], fit.sine + change[2]
    fit.offset, fit.frequency = fit.offset + change[3], fit.frequency + change[4]
    -- Until rounding is all that changes it.
    if turn > 2 and math.abs(change[4]) >= last then return fit end
    if turn > 1 then last = math.abs(change[4]) end
  end
  return fit
end

-- Standard error of the difference of two fits at the same times [Hz]: what both leave alike, such
-- as a bend of the springs' law, is no error of the difference.
function vibration.error_of_difference(one, other, times)
  local squares = 0
  for i, rest in ipairs(one.rest) do squares = squares + (rest - other.rest[i]) ^ 2 end
  local inverse = solve(normal_equations(one, times, one.rest), {0, 0, 0, 1})
  return math.sqrt(squares / (#times - 4) * inverse[4])
end

return vibration
