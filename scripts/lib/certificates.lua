-- Prints the certificates of levels: errors relative to the base and the verdict.

local s = require "springlod"

local certificates = {}

local columns = {"level", "f1..10", "f11..20", "fitted loads", "held-out loads", "lowest MAC",
                 "omega_max / base", "cost / base", "second moments", "zero modes", "verdict"}

-- `fraction` is nil if the quantity was not measured.
local function percent(fraction)
  return fraction and ("%.2f %%"):format(100 * fraction) or "-"
end

local function ratio(value, reference)
  return value and reference and reference > 0 and ("%.3g"):format(value / reference) or "-"
end

local function lowest_mac(frequencies)
  local lowest
  for _, frequency in ipairs(frequencies) do
    lowest = math.min(lowest or frequency.mac, frequency.mac)
  end
  return lowest and ("%.3f"):format(lowest) or "-"
end

local function row(level)
  local c = level.certificate
  return {level.level, percent(c.f1_10_error), percent(c.f11_20_error),
          percent(c.fitted_load_error), percent(c.held_out_load_error), lowest_mac(c.frequencies),
          ratio(c.highest_frequency, c.base_highest_frequency), ratio(c.cost, c.base_cost),
          percent(c.second_moment_error), ("%d of %d"):format(c.zero_modes, c.expected_zero_modes),
          #c.misses == 0 and "within tolerance" or "outside tolerance"}
end

local function moduli_line(level, m)
  return ("level %d, %s: E %.4g Pa (base %.4g, %+.2f %%), nu %.3f (base %.3f)"):format(
    level.level, m.material, m.young, m.base_young, 100 * (m.young / m.base_young - 1), m.poisson,
    m.base_poisson)
end

-- `levels`: those of s.info. Prints nothing if no level has a certificate.
function certificates.print(levels)
  local measured, rows = {}, {}
  for _, level in ipairs(levels) do
    if level.certificate then
      measured[#measured + 1] = level
      rows[#rows + 1] = row(level)
    end
  end
  if #rows == 0 then return end
  print("\ncertificate (mean errors relative to the base):")
  print(s.format_table(rows, {columns = columns}))
  for _, level in ipairs(measured) do
    for _, m in ipairs(level.certificate.moduli) do print(moduli_line(level, m)) end
  end
  for _, level in ipairs(measured) do
    local misses = level.certificate.misses
    if #misses > 0 then
      print(("level %d is outside tolerance: %s"):format(level.level, table.concat(misses, "; ")))
    end
  end
end

return certificates
