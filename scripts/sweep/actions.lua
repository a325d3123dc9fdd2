-- What springlod sweep does: one function for each action, called with its arguments.

local s = require "springlod"
local command = require "lib.command"
local merge = require "sweep.merge"
local show = require "lib.show"
local study = require "lib.study"
local update_rate = require "sweep.update_rate"

local actions = {}

-- The path of a script that is named as a file or, for a study, as a command.
local function script_of(name)
  for _, one in ipairs(study.names) do
    if name == one then return command.path_of(one) end
  end
  local file <close> = io.open(name)
  if not file and name:find("^[%w_-]+$") then
    error(("'%s' is neither a file nor one of %s"):format(name, table.concat(study.names, ", ")), 0)
  end
  return name
end

-- The sweep that the script at `path` returns, called with `arguments`.
local function load_sweep(path, arguments)
  study.planning = true
  local folder = path:match("^(.*)/") or "."
  package.path = folder .. "/?.lua;" .. package.path
  rawset(_G, "arg", {[0] = path, table.unpack(arguments)})
  local chunk, message = loadfile(path)
  if not chunk then error(message, 0) end
  local sweep = chunk(table.unpack(arguments))
  if type(sweep) ~= "userdata" or not sweep.stages then
    error(("%s must return s.sweep{...}"):format(path), 0)
  end
  return sweep
end

local function time_of(seconds) return show.measured(seconds, "time") end

-- What to type for an action on a folder.
local function command_of(action, folder)
  return command.shell_line{"springlod", "sweep", action, folder}
end

function actions.plan(args)
  local folder = args.out or "out/sweep"
  local script = script_of(args.target)
  local sweep = load_sweep(script, args.arguments)
  local estimated = false
  for _, stage in ipairs(sweep.stages) do estimated = estimated or stage.estimated end
  local plan = s.plan_sweep(sweep, folder, {
    script = script, arguments = args.arguments,
    seconds_per_cost = estimated and 1 / update_rate() or args.seconds or 1,
    pilot = estimated and script == args.target, -- studies estimate times
  })
  print(tostring(sweep))
  print(("%s of about %s each, %s of one core in all"):format(show.count(plan.tasks, "task"),
    time_of(plan.seconds / plan.tasks), time_of(plan.seconds)))
  print("next: " .. command_of("run", folder))
end

local function print_status(folder)
  local status = s.sweep_status(folder)
  local parts = {("%d of %s done"):format(status.done, show.count(status.units, "unit"))}
  for _, name in ipairs{"running", "failed", "lost", "missing"} do
    if status[name] > 0 then parts[#parts + 1] = ("%d %s"):format(status[name], name) end
  end
  if status.seconds_left > 0 then
    parts[#parts + 1] = ("about %s of one core left"):format(time_of(status.seconds_left))
  end
  print(table.concat(parts, ", "))
  return status
end

function actions.run(args)
  s.run_sweep(args.target, {task = args.task, workers = args.workers})
  local status = print_status(args.target)
  if status.failed + status.lost > 0 then
    print(command_of("merge", args.target) .. " lists failed and lost units")
  end
end

-- Gives what is missing to a cluster.
function actions.submit(args)
  local engine = args.engine or "slurm"
  local result = s.submit_sweep(args.target, {
    engine = engine, hosts = args.hosts, at_once = args.at_once, time = args.time,
    memory = args.memory, options = #args.sbatch > 0 and args.sbatch or nil,
    dry_run = args.dry_run or false,
  })
  if args.dry_run then
    io.write(result)
  elseif result == "" then
    print_status(args.target)
  elseif engine == "slurm" then
    print(("jobs of Slurm: %s (%s shows how far they are)"):format(result,
      command_of("status", args.target)))
  else
    print_status(args.target)
  end
end

function actions.status(args) print_status(args.target) end

function actions.resume(args)
  if args.again then
    s.say(("%s to be tried again"):format(show.count(s.forget_failures(args.target), "unit")))
  end
  return (args.engine and actions.submit or actions.run)(args)
end

function actions.merge(args) s.merge_sweep(args.target) end

-- The sweep of the script that another process of this program names as the first argument.
local function named_sweep(args)
  return load_sweep(table.remove(args.arguments, 1), args.arguments)
end

-- What s.run_sweep starts.
function actions.work(args) s.work_on_sweep(named_sweep(args), args.target, args.log) end

-- What s.merge_sweep starts.
function actions.gather(args)
  merge(named_sweep(args), args.target)
  s.say("wrote " .. args.target)
end

return actions
