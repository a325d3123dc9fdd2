-- Prints the certificates of levels: the grade in words, errors relative to the base, and the cost.

local s = require "springlod"
local show = require "lib.show"

local certificates, percent = {}, show.percent

local columns = {"level", "f1..10", "f11..20", "MAC", "local loads", "impact", "first period",
                 "decay", "area / mass", "cost / base", "time / base"}

local function number(value, pattern) return value and pattern:format(value) or "-" end

local function row(level)
  local c = level.certificate
  return {level.level, percent(c.f1_10_error), percent(c.f11_20_error), number(c.mac, "%.3f"),
          percent(c.held_out_load_error), percent(c.blow_error), percent(c.first_period_error),
          percent(c.decay_error), number(c.contact_ratio, "%.2f"), number(c.cost_ratio, "%.3g"),
          number(c.seconds_ratio, "%.3g")}
end

local function modulus(m)
  return ("%s E %s (%.2f of the base), nu %.2f (%.2f)"):format(m.material,
    show.quantity(m.young, "pressure"), m.young / m.base_young, m.poisson, m.base_poisson)
end

-- What a level is worth, in words.
local function sentence(level)
  local c = level.certificate
  return ("level %d is %s; %s"):format(level.level, c.summary, c.seconds_ratio and
    ("a simulated second takes an estimated %s (kernel: %s), that of the base %s (%s)"):format(
      show.quantity(c.seconds, "time"), c.kernel, show.quantity(c.base_seconds, "time"),
      c.base_kernel) or "it has no springs")
end

local function mechanisms(model)
  local count = 0
  for _, part in ipairs(s.zero_modes(model)) do count = count + part.zero_modes - part.expected end
  return count
end

-- Warns in one line of levels that fold where the base does not: `which` is a list of numbers of
-- levels, nil: all. `name`: the file of the asset.
function certificates.warn_of_faults(chain, name, which)
  local faulty, worst, of_base = {}, 0, nil
  if not which then
    which = {}
    for level = 1, chain.coarsest do which[level] = level end
  end
  for _, level in ipairs(which) do
    local found = level > 0 and mechanisms(chain[level]) or 0
    if found > 0 then of_base = of_base or mechanisms(chain[0]) end
    if found > (of_base or 0) then
      faulty[#faulty + 1] = level
      worst = math.max(worst, found)
    end
  end
  if #faulty == 0 then return end
  s.say(("%s: level%s %s %s faulty: parts fold without resistance (%d zero modes too many); use a "
    .. "finer level, or convert again with %s"):format(name, #faulty == 1 and "" or "s",
    table.concat(faulty, ", "), #faulty == 1 and "is" or "are", worst,
    faulty[1] > 1 and ("--levels %d or a smaller --cell"):format(faulty[1] - 1)
      or "a smaller --cell"))
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
  print("\ncertificate (mean errors relative to the base; springlod help certificates explains "
    .. "them):")
  print(s.format_table(rows, {columns = columns}))
  for _, level in ipairs(measured) do print(sentence(level)) end
  for _, level in ipairs(measured) do
    local moduli = {}
    for i, m in ipairs(level.certificate.moduli) do moduli[i] = modulus(m) end
    if #moduli > 0 then
      print(("level %d, moduli: %s"):format(level.level, table.concat(moduli, "; ")))
    end
  end
  for _, level in ipairs(measured) do
    for _, text in ipairs(level.certificate.misses) do
      print(("level %d is outside tolerance: %s"):format(level.level, text))
    end
  end
end

return certificates
