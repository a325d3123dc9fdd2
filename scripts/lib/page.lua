-- A page to send round: one HTML file that shows what a command has found. It opens from disk,
-- without network: pictures, film, data, styles and scripts are inside.
--
-- page.write(path, {
--   command = "compare", title = "...",          what it is about
--   verdict = {"One sentence.", "Another."},     what has been found, in words
--   film = {path = , panels = {"base", ...}},    an .mp4, and the level in each of its panels
--   view = s.view(...),                          levels in 3D; with chains = {names} if of several
--   facts = {["level 1"] = "4 times cheaper"},     a remark on each level in 3D
--   values = {label = , of = {["level 1"] = {}}},  numbers on the nodes in 3D, as colours
--   charts = {{series, options}, ...},           as for s.chart; a point whose clip (or label) is a
--                                                level in 3D or in the film plays it
--   pictures = {{path = , caption = }},          .png and .svg files; those that are missing, as
--                                                without gnuplot, are left out
--   tables = {{title = , columns = , rows = , note = }},
--   line = "springlod ...",                      the command to copy
--   provenance = {{"seed", "1"}, ...},
-- })
--
-- Everything but the title may be missing.

local s = require "springlod"

local page = {}

-- Pages are sent by mail: less than 5 MB. What would not fit becomes a link.
local most_bytes = 4.8e6

local here = assert(package.searchpath("lib.page", package.path)):gsub("lib/page%.lua$", "page/")
local scripts = {"data.js", "chart.js", "camera.js", "shaders.js", "viewer.js", "controls.js",
                 "page.js"}

local function read(name)
  local file = assert(io.open(here .. name, "r"))
  local text = file:read("a")
  file:close()
  return text
end

local entities = {["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;"}
local function escaped(text) return (tostring(text):gsub('[&<>"]', entities)) end

-- An element with escaped text.
local function element(name, text) return ("<%s>%s</%s>"):format(name, escaped(text), name) end

-- Whether there is a file; a film is missing without ffmpeg.
local function exists(path)
  local file = io.open(path, "r")
  if file then file:close() end
  return file ~= nil
end

local function list_of(items, make)
  local parts = {}
  for i, item in ipairs(items or {}) do parts[i] = make(item, i) end
  return parts
end

-- ---- Tables ------------------------------------------------------------------------------------

local function cell_text(cell)
  if math.type(cell) == "float" then return ("%.4g"):format(cell) end
  return tostring(cell == nil and "" or cell)
end

local function is_number(cell)
  return type(cell) == "number"
    or type(cell) == "string" and cell:find("^[<>]? ?[%+%-]?%d[%d%.e%+%-]*[ %%]*$")
end

local function table_section(one)
  local numeric, rows = {}, {}
  for i, row in ipairs(one.rows) do
    local cells = {}
    for c, column in ipairs(one.columns) do
      local cell = row[c]
      if cell == nil then cell = row[column] end
      if numeric[c] == nil and cell ~= nil and cell ~= "" then
        numeric[c] = is_number(cell) and true or false
      end
      cells[c] = ("<td%s%s>%s</td>"):format(numeric[c] and ' class="number"' or "",
        c == 1 and (' data-label="%s"'):format(escaped(cell_text(cell))) or "",
        escaped(cell_text(cell)))
    end
    rows[i] = "<tr>" .. table.concat(cells) .. "</tr>"
  end
  local heads = list_of(one.columns, function(column, c)
    return ('<th scope="col"%s>%s</th>'):format(numeric[c] and ' class="number"' or "",
      escaped(column))
  end)
  return ('<section class="wide">%s<div class="table" tabindex="0" role="region" aria-label="%s">'
    .. "<table><thead><tr>%s</tr></thead><tbody>%s</tbody></table></div>%s</section>"):format(
    element("h2", one.title), escaped(one.title), table.concat(heads), table.concat(rows, "\n"),
    one.note and ('<p class="note">%s</p>'):format(escaped(one.note)) or "")
end

-- ---- What may be too large ----------------------------------------------------------------------

-- Embeds files as long as they fit.
local function embedder(bytes_left)
  return function(path, mime)
    local data = s.base64(path)
    if #data > bytes_left then return nil end
    bytes_left = bytes_left - #data
    return ("data:%s;base64,%s"):format(mime, data)
  end
end

local function file_link(path)
  local name = path:match("[^/]+$")
  return ('<p class="missing">Too large for this page: see <a href="%s">%s</a> beside it.</p>')
    :format(escaped(name), escaped(name))
end

local function film_section(film, embed)
  local source = embed(film.path, "video/mp4")
  return ('<section class="film-section"><h2>%s</h2>%s%s</section>'):format(
    escaped(film.title or "The runs side by side"),
    source and ('<div class="film"><video id="film" controls loop muted playsinline '
      .. 'preload="auto" src="%s"></video><div id="film-panel" hidden></div></div>'):format(source)
      or file_link(film.path),
    film.caption and ('<p class="note">%s</p>'):format(escaped(film.caption)) or "")
end

local mimes = {png = "image/png", svg = "image/svg+xml"}

local function picture_section(picture, embed)
  local source = embed(picture.path, mimes[picture.path:match("%w+$")])
  local caption = escaped(picture.caption)
  return ('<figure class="picture">%s<figcaption>%s</figcaption></figure>'):format(
    source and ('<img src="%s" alt="%s">'):format(source, caption) or file_link(picture.path),
    caption)
end

-- ---- Data of the scripts ------------------------------------------------------------------------

-- A point of s.chart with names for its coordinates.
local function chart_point(point)
  local named = {x = point[1], y = point[2], clip = point.clip or point.label}
  for _, key in ipairs{"label", "low", "high", "x_low", "x_high"} do named[key] = point[key] end
  return named
end

local function chart_data(chart)
  local series, options = chart[1], chart[2]
  return {
    title = options.title, x_label = options.x_label, y_label = options.y_label,
    log_x = options.log_x or false, log_y = options.log_y or false, y_from = options.y_from,
    series = list_of(series, function(one)
      return {name = one.name, colour = one.colour, symbol = one.symbol, joined = one.joined,
              dashed = one.dashed, points = list_of(one.points, chart_point)}
    end),
  }
end

-- Node values with their range over all levels.
local function values_data(values)
  if not values then return nil end
  local low, high = math.huge, -math.huge
  for _, list in pairs(values.of) do
    for _, value in ipairs(list) do low, high = math.min(low, value), math.max(high, value) end
  end
  return {label = values.label, of = values.of, low = low, high = high}
end

local function script_data(contents)
  local view = contents.view
  local film = contents.film and exists(contents.film.path) and contents.film or nil
  if view then
    view.chains, view.values = contents.chains, values_data(contents.values)
  end
  local text = s.json{view = view, facts = contents.facts or {},
                      panels = film and film.panels,
                      charts = list_of(contents.charts, chart_data)}
  -- Empty Lua tables are lists to some readers and objects to others; "<" could end the script.
  return (text:gsub("<", "\\u003c"))
end

local function view_section(contents)
  local notes = table.concat(contents.view.left_out or {}, " ")
  local values = contents.view.values
  local scale = values and ('<p class="note">%.3g <span class="scale"></span> %.3g: %s</p>'):format(
    values.low, values.high, escaped(values.label)) or ""
  return ('<section><h2>The levels in 3D</h2><div id="scene"></div>%s%s</section>'):format(scale,
    notes ~= "" and ('<p class="note">%s</p>'):format(escaped(notes)) or "")
end

-- ---- The page -----------------------------------------------------------------------------------

local function grid(sections, class)
  if #sections == 0 then return "" end
  return ('<div class="grid%s">%s</div>'):format(class or "", table.concat(sections, "\n"))
end

local function last_section(contents)
  local parts = {}
  if contents.line then
    parts[#parts + 1] = '<section><h2>Do it again</h2><div class="command"><pre id="command">'
      .. escaped(contents.line)
      .. '</pre><button type="button" id="copy">copy</button></div></section>'
  end
  if contents.provenance then
    local rows = list_of(contents.provenance, function(entry)
      return element("dt", entry[1]) .. element("dd", entry[2])
    end)
    parts[#parts + 1] = "<section><h2>Where it comes from</h2><dl>" .. table.concat(rows, "\n")
      .. "</dl></section>"
  end
  return grid(parts)
end

local policy = "default-src 'none'; img-src data:; media-src data:; style-src 'unsafe-inline'; "
  .. "script-src 'unsafe-inline'"

-- Film and charts on the left, the 3D view beside them; more charts below. `beside`: how many
-- sections the 3D view may have on its left.
local beside = 2
local function upper_half(contents, charts, pictures, embed)
  local left, below = {}, {}
  if contents.film and exists(contents.film.path) then
    left[1] = film_section(contents.film, embed)
  end
  for _, chart in ipairs(charts) do
    local into = contents.view and #left < beside and left or below
    into[#into + 1] = chart
  end
  if not contents.view then
    return grid(left) .. grid(below, #below > 2 and " many") .. grid(pictures, " many")
  end
  local stack = '<div class="stack%s">%s</div>'
  local one = #pictures == 1 and pictures[1] or ""
  return grid({stack:format("", table.concat(left, "\n")),
               stack:format(" side", view_section(contents) .. one)})
    .. grid(below, #below > 2 and " many") .. grid(#pictures > 1 and pictures or {}, " many")
end

-- Writes the page.
function page.write(path, contents)
  local data = script_data(contents)
  local code = table.concat(list_of(scripts, read), "\n")
  local css = read("page.css")
  local embed = embedder(most_bytes - #data - #code - #css)
  local charts = list_of(contents.charts, function(chart, i)
    return ('<section><h2>%s</h2><figure id="chart-%d"></figure></section>'):format(
      escaped(chart[2].title), i)
  end)
  local pictures = {}
  for _, one in ipairs(contents.pictures or {}) do
    if exists(one.path) then pictures[#pictures + 1] = picture_section(one, embed) end
  end
  local upper = upper_half(contents, charts, pictures, embed)
  s.save_text(path, table.concat({
    "<!doctype html>", '<html lang="en"><head><meta charset="utf-8">',
    ('<meta http-equiv="Content-Security-Policy" content="%s">'):format(policy),
    '<meta name="viewport" content="width=device-width, initial-scale=1">',
    '<link rel="icon" href="data:,">', element("title", contents.title),
    "<style>", css, "</style></head><body><main>",
    ('<header><p class="kind">springlod %s</p>'):format(escaped(contents.command or "")),
    element("h1", contents.title),
    '<div class="verdict">' .. table.concat(list_of(contents.verdict, function(sentence)
      return element("p", sentence)
    end)) .. "</div></header>",
    upper,
    grid(list_of(contents.tables, table_section)), last_section(contents),
    '</main><script type="application/json" id="data">', data, "</script>",
    "<script>", code, "</script></body></html>", "",
  }, "\n"))
end

-- An error in percent; what is smaller comes from rounding.
local function percent(value)
  return value < 0.001 and "less than 0.001 %" or ("%.2g %%"):format(value)
end

-- Remarks on levels from the rows of Comparison:table, for `facts`.
function page.facts(rows)
  local facts = {}
  for _, row in ipairs(rows) do
    if row.level > 0 then
      facts[row.label] = ("cost / %.3g, error %s of the size"):format(row.cost_ratio,
        percent(row.surface_error_percent))
    end
  end
  return facts
end

-- What the rows of Comparison:table say, in sentences.
function page.comparison_verdict(rows)
  local sentences = {}
  for _, row in ipairs(rows) do
    if row.level > 0 then
      local cheaper = row.cost_ratio >= 1
      sentences[#sentences + 1] = ("%s (%d nodes) takes %.3g times %s spring updates than the "
        .. "base; its surface is %s of the body's size away from the base's."):format(
        row.label:gsub("^level", "Level"), row.nodes,
        cheaper and row.cost_ratio or 1 / row.cost_ratio, cheaper and "fewer" or "more",
        percent(row.surface_error_percent))
    end
  end
  if #sentences == 0 then sentences[1] = "The asset has only a base." end
  return sentences
end

-- The chart of cost against error from the same rows, for `charts`.
function page.cost_error(rows)
  local points = {}
  for i, row in ipairs(rows) do
    points[i] = {1 / row.cost_ratio, row.surface_error_percent, label = row.label}
  end
  return {{{points = points}}, {
    title = "Cost against error", x_label = "cost per simulated second (spring updates, base = 1)",
    y_label = "surface error (% of the body's diagonal)", log_x = true,
  }}
end

-- Three digits: 0.123, 2.20, 75.0, 368.
local function digits(value)
  if value == 0 then return "0" end
  local decimals = math.max(0, 2 - math.floor(math.log(math.abs(value), 10)))
  return ("%." .. math.min(decimals, 6) .. "f"):format(value)
end

-- A table for `tables` from the rows of Comparison:table.
function page.comparison_table(rows)
  local shown = {}
  for i, row in ipairs(rows) do
    shown[i] = {
      row.label, row.nodes, row.springs, digits(1e6 * row.step),
      digits(row.cost_ratio), ("%.2f"):format(row.surface_error_percent),
      ("%.2f"):format(row.shape_error_percent), ("%.3f"):format(row.distance),
      ("%.3f"):format(row.distance_spread), ("%.0f"):format(100 * row.energy_difference),
    }
  end
  return {
    title = "Cost and error of each level", rows = shown,
    columns = {"level", "nodes", "springs", "step [µs]", "cost: base / level",
               "surface error [%]", "shape error [%]", "distance [m]", "spread of distance [m]",
               "energy difference [%]"},
    note = "Surface error: rms distance from the nodes of the base until shortly after the first "
      .. "contact, in % of the diagonal of the body. Shape error: the same after the best rigid "
      .. "fit, over the whole run. Distance: how far the body went, or from the obstacle that the "
      .. "scenario names. Energy difference: the largest, in % of the largest kinetic energy of "
      .. "the base. Cost: spring updates per simulated second.",
  }
end

-- Entries of a chain's provenance, after the version and seed of this run.
function page.provenance(chain, more)
  local entries = {{"version", s.version}, {"seed", tostring(s.seed)}}
  for _, entry in ipairs(more or {}) do entries[#entries + 1] = entry end
  local keys = {}
  for key in pairs(chain and chain.provenance or {}) do
    if key ~= "springlod" then keys[#keys + 1] = key end
  end
  table.sort(keys)
  for _, key in ipairs(keys) do
    entries[#entries + 1] = {(key:gsub("_", " ")), chain.provenance[key]}
  end
  return entries
end

return page
