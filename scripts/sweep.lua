-- Plan a sweep of many runs, run it here or on a cluster, and merge the results.

local s = require "springlod"
local command = require "lib.command"
local sweep_actions = require "sweep.actions"

local parser = command.parser("sweep", "Run a sweep: many independent runs, its units, described "
  .. "by a script (s.sweep). plan writes plan.json to a folder; run computes what is missing on "
  .. "all cores, or one task of the plan; submit gives the tasks to a cluster; status counts the "
  .. "units; resume runs what is missing, here or on a cluster; merge writes results.csv, gaps.csv "
  .. "(units without a result, and why) and runs.csv (where and how long), and what the script "
  .. "makes of them. Each result is a file of its own: an interrupted sweep goes on where it was.")
parser:argument("action", "plan, run, submit, status, resume or merge")
parser:argument("target", "plan: the script that returns the sweep; otherwise: the folder of the "
  .. "plan")
parser:argument("arguments", "plan: arguments of the script, after --"):args("*")
command.add_out(parser, "out/sweep")
parser:option("--task", "run one task, counted from 0")
  :convert(command.whole("--task", 0, 10000000)):argname("<n>")
parser:option("--workers", "processes of run and resume (default: one per core)")
  :convert(command.whole("--workers", 1, 1024)):argname("<n>")
parser:option("--seconds", "plan: time of a unit on one core, of a sweep without cost")
  :convert(command.quantity("--seconds", "time")):argname("<time>")
parser:option("--engine", "submit, resume: " .. table.concat(s.choices.engine, " or "))
  :choices(s.choices.engine)
parser:option("--hosts", "submit: file of ssh logins, a line each, for parallel")
  :argname("<file>")
parser:option("--at-once", "submit: largest number of tasks at a time")
  :convert(command.whole("--at-once", 1)):argname("<n>")
parser:option("--time", "submit: limit of a task (default: 4 times the estimate, at least 10min)")
  :convert(command.quantity("--time", "time"))
parser:option("--memory", "submit: of a task [bytes] (default: 2 GB)")
  :convert(command.whole("--memory", 1000000, 10000000000000)):argname("<bytes>")
parser:option("--sbatch", "submit: a further option of sbatch, such as --sbatch=--partition=short")
  :argname("<option>"):count("*")
parser:flag("--dry-run", "submit: print the commands as a script, and submit nothing")
parser:flag("--again", "resume: units that failed or were lost too")
parser:option("--log"):hidden(true)
local args = parser:parse()

local options_of = {
  plan = {seconds = true, arguments = true}, run = {task = true, workers = true},
  submit = {engine = true, hosts = true, at_once = true, time = true, memory = true,
            sbatch = true, dry_run = true},
  status = {}, resume = {workers = true, again = true, engine = true}, merge = {},
  work = {log = true, arguments = true}, gather = {arguments = true},
}
local allowed = options_of[args.action]
if not allowed then
  parser:error(("'%s' must be plan, run, submit, status, resume or merge"):format(args.action))
end
for _, options in pairs(options_of) do
  for name in pairs(options) do
    local given = args[name]
    if given and not allowed[name] and not (type(given) == "table" and #given == 0) then
      parser:error(name == "arguments" and ("%s takes one folder"):format(args.action)
        or ("--%s does not belong to %s"):format(name:gsub("_", "-"), args.action))
    end
  end
end

local ok, reason = command.try(sweep_actions[args.action], args)
if not ok then command.fail("sweep %s: %s", args.action, reason) end
