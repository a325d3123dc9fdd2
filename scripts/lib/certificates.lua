-- Shows what levels were measured to be beside their base.

local s = require "springlod"

local certificates = {}

local columns = {"level", "f1..10", "f11..20", "loads fitted", "loads held out", "least MAC",
                 "omega_max / base", "cost / base", "second moments", "zero modes", "verdict"}

-- Parts of 1; nil where nothing of the kind was measured.
local function percent(part)
  return part and ("%.2f %%"):format(100 * part) or "-"
end

local function ratio(part, whole)
  return part and whole and whole > 0 and ("%.3g"):format(part / whole) or "-"
end

local function least_mac(frequencies)
  local least
  for _, frequency in ipairs(frequencies) do
    least = math.min(least or frequency.mac, frequency.mac)
  end
  return least and ("%.3f"):format(least) or "-"
end

local function row(level)
  local c = level.certificate
  return {level.level, percent(c.f1_10_error), percent(c.f11_20_error),
          percent(c.fitted_load_error), percent(c.held_out_load_error), least_mac(c.frequencies),
          ratio(c.highest_frequency, c.base_highest_frequency), ratio(c.cost, c.base_cost),
          percent(c.second_moment_error), ("%d of %d"):format(c.zero_modes, c.expected_zero_modes),
          #c.misses == 0 and "as asked" or "MISSES"}
end

local function moduli_line(level, m)
  return ("level %d, %s: E %.4g Pa (base %.4g, %+.2f %%), nu %.3f (base %.3f)"):format(
    level.level, m.material, m.young, m.base_young, 100 * (m.young / m.base_young - 1), m.poisson,
    m.base_poisson)
end

-- `levels` as s.info gives them; prints nothing if none has a certificate.
function certificates.print(levels)
  local measured, rows = {}, {}
  for _, level in ipairs(levels) do
    if level.certificate then
      measured[#measured + 1] = level
      rows[#rows + 1] = row(level)
    end
  end
  if #rows == 0 then return end
  print("\nmeasured beside the base (mean errors):")
  print(s.format_table(rows, {columns = columns}))
  for _, level in ipairs(measured) do
    for _, m in ipairs(level.certificate.moduli) do print(moduli_line(level, m)) end
  end
  for _, level in ipairs(measured) do
    local misses = level.certificate.misses
    if #misses > 0 then
      print(("level %d MISSES: %s"):format(level.level, table.concat(misses, "; ")))
    end
  end
end

return certificates
