-- Plan a sweep of many runs, run it here or on a cluster, and merge the results.

local s = require "springlod"
local command = require "lib.command"
local study = require "lib.study"
local sweep_actions = require "sweep.actions"

local parser = command.parser("sweep", "Run a sweep: many independent runs, its units, described "
  .. "by a script (s.sweep). plan writes plan.json to a folder; run computes what is missing on "
  .. "all cores, or one task of the plan; submit gives the tasks to a cluster; status counts the "
  .. "units; resume runs what is missing, here or on a cluster; merge writes results.csv, gaps.csv "
  .. "(units without a result, and why) and runs.csv (where and how long), and what the script "
  .. "makes of them. Each result is a file of its own: an interrupted sweep goes on where it was. "
  .. "plan --portable makes results the same on processors without AVX2, too.",
  {options = "--sbatch"})
parser:argument("action", "plan, run, submit, status, resume or merge")
parser:argument("target", "plan: the script that returns the sweep, or "
  .. table.concat(study.names, ", ", 1, #study.names - 1) .. " or " .. study.names[#study.names]
  .. "; otherwise: the folder of the plan")
parser:argument("arguments", "plan: arguments of the script, after --"):args("*")
command.one_line(parser:option("-o --out", "plan: folder to write to (default: out/sweep)")
  :argname("<folder>"))
parser:option("--task", "run: one task, counted from 0")
  :convert(command.whole("--task", 0, 10000000)):argname("<n>")
parser:option("--workers", "processes of run and resume (default: one per core)")
  :convert(command.whole("--workers", 1, 1024)):argname("<n>")
parser:option("--seconds", "plan: time of a unit on one core, of a sweep without cost")
  :convert(command.quantity("--seconds", "time")):argname("<time>")
parser:option("--engine", "submit, resume: " .. table.concat(s.choices.engine, " or "))
  :choices(s.choices.engine)
parser:option("--hosts", "submit, resume: file of ssh logins, a line each, for parallel")
  :argname("<file>")
parser:option("--at-once", "submit, resume: largest number of tasks of Slurm at a time")
  :convert(command.whole("--at-once", 1)):argname("<n>")
parser:option("--time", "submit, resume: limit of a task of Slurm (default: 4 times the estimate, "
  .. "at least 10min)"):convert(command.quantity("--time", "time"))
parser:option("--memory", "submit, resume: of a task of Slurm [bytes] (default: 2 GB)")
  :convert(command.whole("--memory", 1000000, 10000000000000)):argname("<bytes>")
parser:option("--sbatch", "submit, resume: a further option of sbatch, such as "
  .. "--sbatch=--partition=short"):argname("<option>"):count("*")
parser:flag("--dry-run", "submit: print the commands as a script, and submit nothing")
parser:flag("--again", "resume: units that failed or were lost too")
parser:option("--log"):hidden(true)
local args = parser:parse()

-- The actions that use an option, in the order in which wrong ones are named.
local cluster_options = {"hosts", "at_once", "time", "memory", "sbatch"}
local used_by = {
  {"arguments", "plan", "work", "gather"}, {"out", "plan"}, {"seconds", "plan"}, {"task", "run"},
  {"workers", "run", "resume"}, {"engine", "submit", "resume"}, {"dry_run", "submit"},
  {"again", "resume"}, {"log", "work"},
}
for _, name in ipairs(cluster_options) do used_by[#used_by + 1] = {name, "submit", "resume"} end

local function is_given(name)
  local given = args[name]
  return given and not (type(given) == "table" and #given == 0)
end

local function flag_of(name) return "--" .. name:gsub("_", "-") end

if not sweep_actions[args.action] then
  parser:error(("'%s' must be plan, run, submit, status, resume or merge"):format(args.action))
end
for _, use in ipairs(used_by) do
  local name, users = use[1], {}
  for i = 2, #use do users[use[i]] = true end
  if is_given(name) and not users[args.action] then
    parser:error(name == "arguments" and ("%s takes one folder"):format(args.action)
      or ("%s is for %s, not for %s"):format(flag_of(name), table.concat(use, " and ", 2),
        args.action))
  end
end
if args.action == "resume" then
  if args.engine and args.workers then
    parser:error("--workers is for this machine: give it or --engine, not both")
  end
  for _, name in ipairs(cluster_options) do
    if is_given(name) and not args.engine then
      parser:error(("%s needs --engine, without which resume runs on this machine"):format(
        flag_of(name)))
    end
  end
end

local ok, reason = command.try(sweep_actions[args.action], args)
if not ok then
  command.fail("sweep %s: %s", args.action == "gather" and "merge" or args.action, reason)
end
