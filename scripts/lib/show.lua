-- Numbers for people: few digits, and the unit that makes them short. CSV files keep all digits.

local show = {}

-- Size and name of each unit, and the least value that it is used for, if that is not 1 of it.
local units = {
  length = {{1e3, "km"}, {1, "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}},
  time = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}},
  mass = {{1e3, "t"}, {1, "kg"}, {1e-3, "g"}, {1e-6, "mg"}},
  pressure = {{1e9, "GPa"}, {1e6, "MPa"}, {1e3, "kPa"}, {1, "Pa"}},
  volume = {{1, "m3", 1e-2}, {1e-6, "cm3", 1e-8}, {1e-9, "mm3"}},
}

-- `digits` significant digits (default: 3), no exponent where that is short: 1000, not 1e+03.
-- Rounding errors of a `scale`, such as -7e-17 of 1, are 0.
function show.number(value, digits, scale)
  if scale and math.abs(value) < 1e-9 * scale then return "0" end
  local text = ("%." .. (digits or 3) .. "g"):format(value)
  if math.abs(value) < 1e6 and text:find("e+", 1, true) then return ("%.0f"):format(value) end
  return text
end

-- A value in SI units with the unit that makes it at least 1: show.quantity(0.00389, "length") is
-- "3.89 mm".
function show.quantity(value, dimension, digits)
  local list = units[dimension]
  local chosen = list[#list]
  for i = #list, 1, -1 do
    -- 999.9 mm is shown as 1000 mm by its digits, so it is 1 m
    local shown = value == 0 and 1 or math.abs(value) -- 0 in the SI unit
    if shown >= 0.9995 * (list[i][3] or list[i][1]) then chosen = list[i] end
  end
  return show.number(value / chosen[1], digits) .. " " .. chosen[2]
end

-- The same with all its digits, for columns: 1.20 ms below 1.29 ms.
function show.measured(value, dimension, digits)
  digits = digits or 3
  local text = show.quantity(value, dimension, digits)
  local number, unit = text:match("^(%S+) (.+)$")
  if value == 0 or number:find("e", 1, true) then return text end
  return show.full(tonumber(number), digits) .. " " .. unit
end

-- A number with all its significant digits: 1.00.
function show.full(value, digits)
  local text = ("%#." .. (digits or 3) .. "g"):format(value)
  if text:find("e+", 1, true) then return show.number(value, digits) end
  return (text:gsub("%.$", ""))
end

-- A fraction in percent with the digits that mean something; "-" for nil, what was not measured.
function show.percent(fraction)
  if not fraction then return "-" end
  local value = 100 * fraction
  local size = math.abs(value)
  if value == 0 then return "0 %" end
  return (size < 1 and "%.2f %%" or size < 10 and "%.1f %%" or "%.0f %%"):format(value)
end

-- "1 unit", "3 units". `plural`: where it is not the singular with an s.
function show.count(number, singular, plural)
  return ("%d %s"):format(number, number == 1 and singular or plural or singular .. "s")
end

return show
