-- A body at falling numbers of nodes, each measured beside its base, and what becomes of a level
-- without its costliest merges.

local s = require "springlod"
local command = require "lib.command"

local merge_ladder = {}

-- `steps` parts of the base's nodes from near 1 down to `least`, each the same part of the one
-- before; no two of them the same number of nodes.
function merge_ladder.parts(base, steps, least)
  local parts, before = {}, base.node_count
  for i = 1, steps do
    local nodes = math.max(1, math.floor(base.node_count * least ^ (i / steps) + 0.5))
    if nodes < before then parts[#parts + 1] = nodes / base.node_count end
    before = nodes
  end
  return parts
end

-- A certified chain of levels with `parts` of the nodes of `base`; `options` are those of
-- s.simplify besides. Where merging cannot come down to the last parts, a shorter chain, and why.
function merge_ladder.build(base, parts, options)
  local reason = "no level would have fewer nodes than the base; ask for fewer"
  for count = #parts, 1, -1 do
    local all = {keep = table.move(parts, 1, count, 1, {})}
    for name, value in pairs(options) do all[name] = value end
    local made, chain = command.try(s.simplify, base, all)
    if made then
      local shortened = count < #parts and reason or nil
      return options.calibrate == "modes" and chain or s.certify(chain), shortened
    end
    reason = chain
  end
  error(reason, 0)
end

-- The merges of a step of s.merge_log in which nodes really merged, the costliest first.
function merge_ladder.merged(step)
  local list = {}
  for _, merge in ipairs(step.merges) do
    if merge.pieces > 1 then list[#list + 1] = merge end
  end
  return list
end

-- The nodes of the base as groups: those of a step's level, but for the merges in `left_out`, of
-- which the pieces stay.
local function groups_without(chain, step, left_out)
  local pieces, nodes = chain:group_map(step.from), chain:group_map(step.level)
  local sets, of = {}, {}
  for i, node in ipairs(nodes) do
    local key = left_out[node] and "piece " .. pieces[i] or node
    if not of[key] then
      of[key] = {}
      sets[#sets + 1] = of[key]
    end
    table.insert(of[key], i)
  end
  local several = {}
  for _, set in ipairs(sets) do
    if #set > 1 then several[#several + 1] = set end
  end
  return several
end

-- The step's level made again without the costliest `part` of its merges: the model, its
-- certificate, how many merges that are; nil if those are none, or all.
function merge_ladder.without_costliest(chain, step, part)
  local merges = merge_ladder.merged(step)
  local count = math.floor(part * #merges + 0.5)
  if count == 0 or count == #merges then return nil end
  local left_out = {}
  for i = 1, count do left_out[merges[i].node] = true end
  local again = s.certify(s.simplify(chain[0], {
    levels = 1, grouping = groups_without(chain, step, left_out),
  }))
  return again[1], s.info(again).levels[2].certificate, count
end

return merge_ladder
