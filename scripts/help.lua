-- Explain a command, a function or a topic of the documentation.

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("help", "Explain a topic: a command (convert), a function or value "
  .. "of scripts (simplify, Material), a page of the documentation (simulate) or a word in the "
  .. "headings of these pages (materials, scenes) or in the glossary (jitter). Of any other "
  .. "word, list the pages that have it. Without a topic, list all topics.")
parser:argument("topic", "what to explain"):args("*")
local topic = table.concat(parser:parse().topic, " ")

-- The pages of the documentation: list of {name, title, text}.
local function pages()
  local all = {}
  if not s.is_folder(s.docs) then return all end
  for _, path in ipairs(s.files(s.docs, {endings = {".md"}})) do
    local file <close> = assert(io.open(path))
    local text = file:read("a")
    local name = command.stem(path)
    if name ~= "README" then
      all[#all + 1] = {name = name, title = text:match("^# ([^\n]+)") or name, text = text}
    end
  end
  return all
end

-- The sections of a page whose headings have the word: list of {heading, lines}. Headings inside
-- code blocks are comments of that code.
local function sections(page, word)
  local found, open, depth, code = {}, nil, 0, false
  for line in (page.text .. "\n"):gmatch("([^\n]*)\n") do
    if line:find("^```") then code = not code end
    local marks, heading = line:match("^(##+) (.*)")
    if marks and not code then
      if open and #marks <= depth then open = nil end
      if not open and (" " .. heading:lower()):find(word, 1, true) then
        open, depth = {heading = heading, lines = {}}, #marks
        found[#found + 1] = open
      end
    end
    if open then table.insert(open.lines, line) end
  end
  return found
end

local function list(title, entries)
  print("\n" .. title)
  local width = 0
  for _, entry in ipairs(entries) do width = math.max(width, #entry[1]) end
  for _, entry in ipairs(entries) do
    print(("  %-" .. width .. "s  %s"):format(entry[1], entry[2]))
  end
end

local function list_commands(study)
  local entries = study and {} or {{"run", "Run a Lua script."}}
  for _, one in ipairs(command.list()) do
    if one.study == study then entries[#entries + 1] = {one.name, one.summary} end
  end
  list(study and "Studies, which evaluate the methods:" or "Commands:", entries)
end

local function list_functions()
  local names = {}
  for name, value in pairs(s) do
    if type(value) == "function" then names[#names + 1] = name end
  end
  table.sort(names)
  print("\nFunctions of scripts (local s = require \"springlod\"; s.simplify):")
  local line = " "
  for _, name in ipairs(names) do
    if #line + #name + 1 > 88 then
      print(line)
      line = " "
    end
    line = line .. " " .. name
  end
  print(line)
end

local function overview()
  print("springlod help TOPIC explains one of these, or a word in the headings of the pages.")
  list_commands(false)
  list_commands(true)
  list_functions()
  local titles = {}
  for _, page in ipairs(pages()) do titles[#titles + 1] = {page.name, page.title} end
  if #titles > 0 then list("Pages:", titles) end
end

local function explain_command(name)
  if name == "run" then
    print("springlod run SCRIPT.lua [-- ARGUMENTS...]  runs a Lua script (springlod run --help).")
    return true
  end
  local path = command.path_of(name)
  if path then print(command.parser_of(path):get_help()) end
  return path ~= nil
end

-- Words that the API calls otherwise.
local other_words = {scene = "Scenario", scenes = "Scenario", materials = "Material"}

-- A function, or a value or table, whose names begin with a capital letter.
local function explain_name(name)
  for _, spelling in pairs{name, (name:gsub("^%l", string.upper)), other_words[name]} do
    if pcall(s.help, spelling) then return true end
  end
  return false
end

local function explain_page(page)
  print((page.text:gsub("\n$", "")))
  return true
end

-- Pages whose sections are many of the same kind, or are printed otherwise.
local not_searched = {api = true, choices = true, method = true, validation = true}

-- The sections whose headings have the word, that with the shortest heading first.
local function find_sections(all, word)
  local found, key = {}, " " .. word:lower():gsub("s$", "")
  for _, page in ipairs(all) do
    for _, section in ipairs(not_searched[page.name] and {} or sections(page, key)) do
      section.place = ("docs/%s.md, %s"):format(page.name, section.heading)
      found[#found + 1] = section
    end
  end
  table.sort(found, function(a, b)
    return #a.heading < #b.heading or #a.heading == #b.heading and a.place < b.place
  end)
  return found
end

local function explain(word)
  local answered = explain_command(word) or explain_name(word)
  local all, also = pages(), {}
  for _, page in ipairs(all) do
    if page.name == word and not answered then
      answered = explain_page(page)
    elseif page.name == word then
      also[#also + 1] = ("docs/%s.md, %s"):format(page.name, page.title)
    end
  end
  for _, section in ipairs(find_sections(all, word)) do
    if answered then
      also[#also + 1] = section.place
    else
      print(("(%s)\n%s"):format(section.place, table.concat(section.lines, "\n")))
      answered = true
    end
  end
  if #also > 0 then print("\nSee also:\n  " .. table.concat(also, "\n  ")) end
  return answered
end

-- Prints what the glossary says of a word, without links.
local function print_definition(word)
  for _, page in ipairs(pages()) do
    for row in (page.name == "glossary" and page.text or ""):gmatch("\n(| %*%*[^\n]+)") do
      local term, rest, meaning = row:match("^| %*%*(.-)%*%*(.-) | (.-) |")
      if term and (term:lower() == word:lower() or term:lower() .. "s" == word:lower()) then
        print(("%s%s: %s"):format(term, rest, (meaning:gsub("%[([^%]]+)%]%([^)]*%)", "%1"))))
        return true
      end
    end
  end
  return false
end

-- At most 64 bytes of a line, up to a space.
local function beginning(line)
  return #line <= 64 and line or line:sub(1, 64):gsub("%s+%S*$", "") .. " ..."
end

-- Whether a line has each word of a topic; a plural finds its singular.
local function mentions(line, topic_words)
  line = line:lower()
  for word in topic_words:lower():gmatch("%S+") do
    if not line:find("%f[%w]" .. word:gsub("s$", ""):gsub("%W", "%%%0")) then return false end
  end
  return true
end

-- Prints the pages whose text has the word, with the most lines first, and the first line of prose
-- of each, or else its title. Returns whether there are any.
local function list_mentions(word)
  local found, for_tasks = {}, {}
  for _, page in ipairs(pages()) do
    local other = not_searched[page.name] and page.name ~= "api" or page.name == "glossary"
    if not other then for_tasks[#for_tasks + 1] = page end
  end
  for _, page in ipairs(for_tasks) do
    local lines, first, code = 0, nil, false
    for line in page.text:gmatch("[^\n]+") do
      if line:find("^```") then code = not code end
      if mentions(line, word) then
        lines = lines + 1
        first = first or not code and not line:find("^|") and line:match("^%s*(.*)") or nil
      end
    end
    first = first or page.title
    if lines > 0 then found[#found + 1] = {page = page, lines = lines, first = first} end
  end
  if #found == 0 then return false end
  table.sort(found, function(a, b)
    return a.lines > b.lines or a.lines == b.lines and a.page.name < b.page.name
  end)
  local entries = {}
  for i = 1, math.min(#found, 6) do
    local one = found[i]
    entries[i] = {("docs/%s.md (%d line%s)"):format(one.page.name, one.lines,
      one.lines == 1 and "" or "s"), beginning(one.first)}
  end
  list(("No heading has '%s'. Pages with it, and their first such lines:"):format(word), entries)
  return true
end

-- Whether one letter more, less, other or swapped with its neighbour makes `a` of `b`.
local function differ_by_one(a, b)
  if #a > #b then a, b = b, a end
  local at = 1
  while at <= #a and a:sub(at, at) == b:sub(at, at) do at = at + 1 end
  local rest_a, rest_b = a:sub(at), b:sub(at)
  return rest_a == rest_b:sub(2) or #a == #b and (rest_a:sub(2) == rest_b:sub(2)
    or rest_a:sub(3) == rest_b:sub(3) and rest_a:sub(1, 2) == rest_b:sub(1, 2):reverse())
end

-- "; did you mean pick?", or nothing.
local function suggestion(word)
  local names = {}
  for _, one in ipairs(command.list()) do names[#names + 1] = one.name end
  for _, page in ipairs(pages()) do names[#names + 1] = page.name end
  local functions = {}
  for name, value in pairs(s) do
    if type(value) == "function" then functions[#functions + 1] = name end
  end
  table.sort(functions)
  table.move(functions, 1, #functions, #names + 1, names)
  for _, name in ipairs(names) do
    if differ_by_one(word:lower(), name) then return ("; did you mean %s?"):format(name) end
  end
  return ""
end

if topic == "" then
  overview()
elseif not explain(topic) then
  local suggested = suggestion(topic)
  local defined = print_definition(topic)
  if (defined or suggested == "") and list_mentions(topic) or defined then return end
  command.fail("no help on '%s'%s; springlod help lists all topics", topic, suggested)
end
