-- Least-squares fit of a vibration A cos(w t) + B sin(w t) + C.

local linear = require "lib.linear"

local vibration = {}

-- The fitted value at time t and its derivatives with respect to cosine, sine, offset and
-- frequency. Time is measured from the middle of the samples, which decorrelates frequency and
-- phase.
local function value_and_derivatives(fit, t)
  local phase = 2 * math.pi * fit.frequency * (t - fit.middle)
  local c, s = math.cos(phase), math.sin(phase)
  local turn = 2 * math.pi * (t - fit.middle)
  return fit.cosine * c + fit.sine * s + fit.offset,
    {c, s, 1, turn * (fit.sine * c - fit.cosine * s)}
end

-- The normal equations of the Gauss-Newton step, and the residuals (value minus fit).
local function normal_equations(fit, times, values)
  local matrix = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}
  local right, residuals = {0, 0, 0, 0}, {}
  for i, t in ipairs(times) do
    local value, derivatives = value_and_derivatives(fit, t)
    residuals[i] = values[i] - value
    for j = 1, 4 do
      right[j] = right[j] + derivatives[j] * residuals[i]
      for k = 1, 4 do matrix[j][k] = matrix[j][k] + derivatives[j] * derivatives[k] end
    end
  end
  return matrix, right, residuals
end

-- Fits values at times [s]. The initial frequency [Hz] must be accurate to a small fraction of a
-- period over the whole time. Fields of the result: frequency [Hz], residuals, and others.
function vibration.fit(times, values, frequency)
  local fit = {frequency = frequency, middle = (times[1] + times[#times]) / 2,
    cosine = 0, sine = 0, offset = 0}
  local last = math.huge
  for iteration = 1, 50 do -- Gauss-Newton; converges in a few iterations
    local matrix, right, residuals = normal_equations(fit, times, values)
    fit.residuals = residuals
    if iteration == 1 then -- keep the frequency while the amplitude is still 0
      matrix[4], right[4] = {0, 0, 0, 1}, 0
      for j = 1, 3 do matrix[j][4] = 0 end
    end
    local change = linear.solve(matrix, right)
    fit.cosine, fit.sine = fit.cosine + change[1], fit.sine + change[2]
    fit.offset, fit.frequency = fit.offset + change[3], fit.frequency + change[4]
    -- Converged: the change is only rounding error.
    if iteration > 2 and math.abs(change[4]) >= last then return fit end
    if iteration > 1 then last = math.abs(change[4]) end
  end
  return fit
end

-- Standard error of the frequency difference of two fits at the same times [Hz]. Residuals common
-- to both, such as those of the geometric nonlinearity, cancel.
function vibration.error_of_difference(one, other, times)
  local squares = 0
  for i, residual in ipairs(one.residuals) do
    squares = squares + (residual - other.residuals[i]) ^ 2
  end
  local inverse = linear.solve(normal_equations(one, times, one.residuals), {0, 0, 0, 1})
  return math.sqrt(squares / (#times - 4) * inverse[4])
end

return vibration
