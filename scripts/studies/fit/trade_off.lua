-- Gain against errors of fits that aim at different highest frequencies: the trade-off that the
-- default was chosen on.

local s = require "springlod"
local command = require "lib.command"

local trade_off = {}

-- Factors on the least_frequency of the default.
local factors = {1.5, 1.3, 1.15, 1, 0.9, 0.8}

local function default_aim()
  for _, option in ipairs(s.options_of("Calibration")) do
    if option.name == "least_frequency" then return tonumber(option.default) end
  end
end

-- The default, with lower and higher highest frequencies.
function trade_off.variants()
  local list, default = {}, default_aim()
  for i, factor in ipairs(factors) do
    local aim = factor * default
    list[i] = {name = ("%.2f"):format(aim), calibration = {least_frequency = aim},
               is_default = factor == 1}
  end
  return list
end

local lines = {
  {"periods 2..5", "pink"}, {"period 1", "orange"}, {"held-out loads", "green"},
  {"f11..20", "sky"}, {"f1..10", "blue"},
}

-- Writes folder/trade-off.svg and .png. value_of(level, variant, measure) returns the mean of a
-- measure.
function trade_off.chart(folder, variants, levels, value_of)
  local series, rings = {}, {}
  for level = 1, levels do
    for _, line in ipairs(lines) do
      local measure, points = line[1], {}
      for i, variant in ipairs(variants) do
        points[i] = {value_of(level, variant, "gain"), value_of(level, variant, measure)}
        if variant.is_default then rings[#rings + 1] = points[i] end
      end
      series[#series + 1] = {name = level == 1 and measure or nil, points = points,
                             colour = line[2], symbol = level == 1 and "disc" or "triangle"}
    end
  end
  series[#series + 1] = {name = "default", points = rings, colour = "black", symbol = "ring",
                         joined = false}
  command.chart(folder .. "/trade-off", series, {
    title = "What a longer step costs in accuracy: levels 1 (left) and 2",
    x_label = "gain: base cost / cost of a simulated second (springs over stable step)",
    y_label = "error [%]", log_x = true, log_y = true,
  })
end

return trade_off
