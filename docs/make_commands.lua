-- Writes what is made from the help of the commands: docs/commands.md, the man pages and the
-- completion for bash, fish and zsh.
--
--   springlod --unsafe run docs/make_commands.lua -- --reference docs/commands.md
--   springlod --unsafe run docs/make_commands.lua -- --man DIR --completion DIR

local s = require "springlod"
local command = require "lib.command"

local parser = command.parser("run docs/make_commands.lua --",
  "Write the reference, man pages and shell completion of the commands, from their help.")
parser:option("--reference", "Markdown file to write"):argname("<file>")
parser:option("--man", "folder for the man pages"):argname("<folder>")
parser:option("--completion", "folder for springlod.bash, .fish and .zsh"):argname("<folder>")
local args = parser:parse()

-- ---------------------------------------------------------------- the commands

-- The parser that a script makes: it runs up to the point where it parses its arguments.
local function parser_of(script)
  local make, found = command.parser, {}
  function command.parser(...)
    local made = make(...)
    function made.parse() error(found, 0) end
    found.parser = made
    return made
  end
  local ok, failure = pcall(assert(loadfile(script)))
  command.parser = make
  if ok or failure ~= found then
    error(("%s does not parse its arguments: %s"):format(script, tostring(failure)), 0)
  end
  return found.parser
end

-- An argument or option: its names (none for an argument), what follows them, its help.
local function entry_of(element)
  local choices = {}
  for _, word in ipairs(element._choices or element.completed or {}) do
    choices[#choices + 1] = word
  end
  return {names = element._aliases, label = table.concat(element:_get_label_lines(), ", "),
          help = element:_get_description(), choices = choices,
          flag = element._aliases and element._maxargs == 0, path = element._argname,
          name = element._name, values = element._maxargs,
          repeats = element._aliases and element._maxcount > 1}
end

-- Groups of entries: arguments, the named groups, other options.
local function groups_of(made)
  local groups, in_group = {}, {}
  local function add(name, elements)
    local entries = {}
    for _, element in ipairs(elements) do
      if not in_group[element] then
        in_group[element] = true
        entries[#entries + 1] = entry_of(element)
      end
    end
    if #entries > 0 then groups[#groups + 1] = {name = name, entries = entries} end
  end
  add("Arguments", made._arguments)
  for _, group in ipairs(made._groups) do add(group.name, group) end
  add("Options", made._options)
  return groups
end

local function commands_in(folder, study)
  local commands = {}
  for _, script in ipairs(s.files(folder, {endings = {".lua"}})) do
    local made = parser_of(script)
    commands[#commands + 1] = {
      name = command.stem(script), study = study, summary = io.lines(script)():gsub("^%-+ *", ""),
      description = made._description, usage = made:get_usage(), groups = groups_of(made),
    }
    collectgarbage() -- closes the file of io.lines
  end
  return commands
end

local scripts = package.searchpath("lib.command", package.path):match("^(.*)/lib/command.lua$")
local commands = commands_in(scripts, false)
table.move(commands_in(scripts .. "/studies", true), 1, 1000, #commands + 1, commands)

-- The text of `springlod --help`, from the program that runs this script.
local function program_help()
  local pipe = io.popen("/proc/" .. io.open("/proc/self/stat"):read("n") .. "/exe --help")
  local text = pipe:read("a")
  pipe:close()
  return text
end
local overview = program_help()

-- Flags of the program: "-q, --quiet    print ..." -> names, help.
local flags = {}
local follow = overview:match("\nflags %((.-) may also follow the command")
for line in overview:match("\nflags.-\n(.*)"):gmatch("[^\n]+") do
  local label, help = line:match("^  (%-.-)  +(.+)$")
  if label then
    local names = {}
    for name in label:gmatch("%-[%w-]+") do names[#names + 1] = name end
    flags[#flags + 1] = {names = names, label = label, help = help,
                         flag = not label:find("[ =]%u"),
                         follows = follow:find(names[1], 1, true) ~= nil}
  end
end

-- ---------------------------------------------------------------- Markdown

local function cell(text) return (text:gsub("|", "\\|"):gsub("<", "&lt;"):gsub("\n", " ")) end

local function reference()
  local lines = {
    "# The commands", "",
    "Made from their help: `springlod --unsafe run docs/make_commands.lua -- --reference "
      .. "docs/commands.md`. Do not edit.", "",
    "```text", (overview:gsub("^springlod %S+", "springlod"):gsub("\n+$", "")), "```", "",
  }
  local function add(text) lines[#lines + 1] = text end
  for _, each in ipairs(commands) do
    add(("## %s\n"):format(each.name))
    add(each.description .. "\n")
    add("```text\n" .. each.usage .. "\n```\n")
    for _, group in ipairs(each.groups) do
      add(("| %s | meaning |\n|---|---|"):format(group.name:lower()))
      for _, entry in ipairs(group.entries) do
        add(("| `%s` | %s |"):format((entry.label:gsub("|", "\\|")), cell(entry.help)))
      end
      add("")
    end
  end
  return (table.concat(lines, "\n"):gsub("\n+$", "\n"))
end

-- ---------------------------------------------------------------- man pages

-- Text for roff: what it takes for a command is escaped.
local function roff(text)
  return (text:gsub("\\", "\\e"):gsub("%-", "\\-"):gsub("\n%.", "\n\\&."):gsub("^([.'])", "\\&%1"))
end

local function heading(name)
  return ('.TH %s 1 "" "springlod %s" "springlod"'):format(name:upper(), s.version)
end

local function verbatim(text) return ".nf\n" .. roff(text) .. "\n.fi" end

local function tagged(entry)
  return (".TP\n.B %s\n%s"):format(roff(entry.label), roff(entry.help))
end

local function man_of(each)
  local lines = {
    heading("springlod-" .. each.name), ".SH NAME",
    ("springlod\\-%s \\- %s"):format(each.name, roff((each.summary:gsub("%.$", "")))),
    ".SH SYNOPSIS", verbatim((each.usage:gsub("^Usage: ", ""):gsub("\n       ", "\n"))),
    ".SH DESCRIPTION", roff(each.description),
  }
  for _, group in ipairs(each.groups) do
    lines[#lines + 1] = ".SH " .. group.name:upper()
    for _, entry in ipairs(group.entries) do lines[#lines + 1] = tagged(entry) end
  end
  lines[#lines + 1] = ".SH SEE ALSO\n.BR springlod (1)"
  return table.concat(lines, "\n") .. "\n"
end

local function program_man()
  local lines = {
    heading("springlod"), ".SH NAME",
    "springlod \\- level\\-of\\-detail mass\\-spring models from meshes, scripted in Lua",
    ".SH SYNOPSIS", verbatim((overview:match("usage: (.-)\n\n"):gsub("\n       ", "\n"))),
    ".SH DESCRIPTION", "Each command has a page of its own, such as",
    ".BR springlod\\-convert (1).", "Without a command, springlod opens a prompt: type help().",
  }
  for _, study in ipairs{false, true} do
    lines[#lines + 1] = study and ".SH STUDIES" or ".SH COMMANDS"
    for _, each in ipairs(commands) do
      if each.study == study then
        lines[#lines + 1] = tagged{label = each.name, help = each.summary}
      end
    end
  end
  lines[#lines + 1] = ".SH OPTIONS"
  for _, flag in ipairs(flags) do lines[#lines + 1] = tagged(flag) end
  lines[#lines + 1] = ".SH FILES\n.TP\n.I ~/.local/state/springlod/history\nlines of the prompt"
  return table.concat(lines, "\n") .. "\n"
end

-- ---------------------------------------------------------------- completion

local function options_of(each)
  local options = {}
  for _, group in ipairs(each.groups) do
    for _, entry in ipairs(group.entries) do
      if entry.names then options[#options + 1] = entry end
    end
  end
  return options
end

local function names_of(entries)
  local names = {}
  for _, entry in ipairs(entries) do table.move(entry.names, 1, 9, #names + 1, names) end
  return table.concat(names, " ")
end

-- "-e|--seed": the names of entries that take a value, as a pattern of case.
local function valued(entries)
  local names = {}
  for _, entry in ipairs(entries) do
    if not entry.flag then table.move(entry.names, 1, 9, #names + 1, names) end
  end
  return table.concat(names, "|")
end

local function bash()
  local all = {"run"}
  for _, each in ipairs(commands) do all[#all + 1] = each.name end
  local lines = {
    "# Completion of springlod for bash. Made by docs/make_commands.lua.",
    "_springlod() {",
    "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= i",
    "  COMPREPLY=()",
    "  for ((i = 1; i < COMP_CWORD; i++)); do",
    "    case ${COMP_WORDS[i]} in",
    ("      %s) ((i++)) ;;"):format(valued(flags)),
    "      -*) ;;",
    "      *) command=${COMP_WORDS[i]}; break ;;",
    "    esac",
    "  done",
    "  local names= words=",
    "  case $command in",
    ("    '') names='%s' words='%s'"):format(names_of(flags), table.concat(all, " ")),
    ("      case $before in %s) return ;; esac ;;"):format(valued(flags)),
  }
  for _, each in ipairs(commands) do
    local options = options_of(each)
    lines[#lines + 1] = ("    %s) names='%s'"):format(each.name, names_of(options))
    lines[#lines + 1] = "      case $before in"
    for _, entry in ipairs(options) do
      if #entry.choices > 0 then
        lines[#lines + 1] = ("        %s) words='%s' ;;"):format(
          table.concat(entry.names, "|"), table.concat(entry.choices, " "))
      end
    end
    lines[#lines + 1] = "      esac ;;"
  end
  table.move({
    "  esac",
    "  if [[ $word == -* ]]; then",
    "    COMPREPLY=($(compgen -W \"$names\" -- \"$word\"))",
    "  elif [[ $words ]]; then",
    "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))",
    "  fi",
    "}",
    "complete -o bashdefault -o default -F _springlod springlod", "",
  }, 1, 10, #lines + 1, lines)
  return table.concat(lines, "\n")
end

local function fish()
  local function quoted(text) return "'" .. text:gsub("[\\']", "\\%0") .. "'" end
  local lines = {"# Completion of springlod for fish. Made by docs/make_commands.lua."}
  local function add(condition, entry)
    local words = {"complete -c springlod -n " .. quoted(condition)}
    for _, name in ipairs(entry.names) do
      words[#words + 1] = name:find("^%-%-") and "-l " .. name:sub(3) or "-s " .. name:sub(2)
    end
    if not entry.flag then words[#words + 1] = "-r" end
    if entry.choices and #entry.choices > 0 then
      words[#words + 1] = "-f -a " .. quoted(table.concat(entry.choices, " "))
    end
    words[#words + 1] = "-d " .. quoted((entry.help:gsub("\n", " ")))
    lines[#lines + 1] = table.concat(words, " ")
  end
  lines[#lines + 1] = "complete -c springlod -f -n __fish_use_subcommand -a run -d "
    .. "'Run a Lua script.'"
  for _, flag in ipairs(flags) do add("__fish_use_subcommand", flag) end
  for _, each in ipairs(commands) do
    lines[#lines + 1] = ("complete -c springlod -f -n __fish_use_subcommand -a %s -d %s"):format(
      each.name, quoted(each.summary))
    for _, entry in ipairs(options_of(each)) do
      add("__fish_seen_subcommand_from " .. each.name, entry)
    end
  end
  return table.concat(lines, "\n") .. "\n"
end

local function zsh()
  local function quoted(text) return "'" .. text:gsub("'", "'\\''") .. "'" end
  -- Help or a name in a field of _arguments, where the marks of its syntax are escaped.
  local function field(text) return (text:gsub("\n", " "):gsub("[%[%]:\\]", "\\%0")) end
  -- What completes a value: its words, files of a kind, or nothing.
  local function action(entry, name)
    if entry.choices and #entry.choices > 0 then
      return "(" .. table.concat(entry.choices, " ") .. ")"
    end
    if name:find("%.lua") then return '_files -g "*.lua"' end
    for _, kind in ipairs{"file", "folder", "asset", "mesh"} do
      if name:find(kind) then return "_files" end
    end
    return " "
  end
  local function value(entry, name)
    return (":%s:%s"):format(field(name), action(entry, entry.path or name))
  end
  local function option(entry)
    local values = ""
    if not entry.flag then values = value(entry, (entry.names[#entry.names]:gsub("^%-+", ""))) end
    if (entry.values or 1) > 1 then values = ":*-*" .. values end -- all words up to an option
    local help, specs = ("[%s]"):format(field(entry.help)), {}
    for i, name in ipairs(entry.names) do
      -- --unit mm and --unit=mm; -o FILE and -oFILE
      local takes = entry.flag and "" or name:find("^%-%-") and "=" or "+"
      -- An option that is given is not offered again, nor its other names.
      local excludes = entry.repeats and "*" or ("(%s)"):format(table.concat(entry.names, " "))
      specs[i] = quoted(excludes .. name .. takes .. help .. values)
    end
    return table.concat(specs, " ")
  end
  local function argument(entry)
    return quoted((entry.values > 1 and "*" or "") .. value(entry, entry.name))
  end
  local lines = {
    "#compdef springlod",
    "# Completion of springlod for zsh. Made by docs/make_commands.lua.",
    "_springlod() {",
    "  local curcontext=$curcontext state line ret=1",
    "  local -A opt_args",
    "  local -a commands=(",
    "    'run:Run a Lua script.'",
  }
  local function add(text) lines[#lines + 1] = text end
  for _, each in ipairs(commands) do
    add("    " .. quoted(each.name .. ":" .. field(each.summary)))
  end
  add("  )")
  add("  _arguments -C \\")
  for _, flag in ipairs(flags) do add("    " .. option(flag) .. " \\") end
  add("    '1: :->command' '*:: :->rest' && ret=0")
  add("  case $state in")
  add("    command) _describe -t commands command commands && ret=0 ;;")
  add("    rest)")
  add("      curcontext=${curcontext%:*}-$words[1]:")
  add("      case $words[1] in")
  add("        run) _arguments '1:script:_files -g \"*.lua\"' '*:argument:_files' && ret=0 ;;")
  for _, each in ipairs(commands) do
    add(("        %s)"):format(each.name))
    add("          _arguments \\")
    for _, group in ipairs(each.groups) do
      for _, entry in ipairs(group.entries) do
        add(("            %s \\"):format((entry.names and option or argument)(entry)))
      end
    end
    for _, flag in ipairs(flags) do
      if flag.follows then add(("            %s \\"):format(option(flag))) end
    end
    add("            && ret=0 ;;")
  end
  table.move({
    "      esac ;;",
    "  esac",
    "  return ret",
    "}",
    "",
    "# As a function of fpath it completes; sourced, it registers itself.",
    "if [[ $funcstack[1] == _springlod ]]; then",
    "  _springlod \"$@\"",
    "else",
    "  compdef _springlod springlod",
    "fi",
    "",
  }, 1, 12, #lines + 1, lines)
  return table.concat(lines, "\n")
end

if args.reference then s.save_text(args.reference, reference()) end
if args.man then
  s.save_text(args.man .. "/springlod.1", program_man())
  for _, each in ipairs(commands) do
    s.save_text(("%s/springlod-%s.1"):format(args.man, each.name), man_of(each))
  end
end
if args.completion then
  s.save_text(args.completion .. "/springlod.bash", bash())
  s.save_text(args.completion .. "/springlod.fish", fish())
  s.save_text(args.completion .. "/springlod.zsh", zsh())
end
