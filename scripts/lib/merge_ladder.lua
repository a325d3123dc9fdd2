-- A chain of levels with decreasing numbers of nodes, each certified, and the same levels without
-- their costliest merges.

local s = require "springlod"
local command = require "lib.command"

local merge_ladder = {}

-- Node counts of `steps` levels as fractions of the base: a geometric sequence that ends at
-- `least`. Counts that round to the same number appear once.
function merge_ladder.fractions(base, steps, least)
  local fractions, before = {}, base.node_count
  for i = 1, steps do
    local nodes = math.max(1, math.floor(base.node_count * least ^ (i / steps) + 0.5))
    if nodes < before then fractions[#fractions + 1] = nodes / base.node_count end
    before = nodes
  end
  return fractions
end

-- A certified chain of levels with `fractions` of the nodes of `base`; `options` are the other
-- options of s.simplify. If merging cannot reach the last fractions, returns a shorter chain and
-- the reason.
function merge_ladder.build(base, fractions, options)
  local reason = "no level would have fewer nodes than the base; lower --least"
  for count = #fractions, 1, -1 do
    local all = {keep = table.move(fractions, 1, count, 1, {})}
    for name, value in pairs(options) do all[name] = value end
    local made, chain = command.try(s.simplify, base, all)
    if made then
      local shortened = count < #fractions and reason or nil
      return options.calibrate == "modes" and chain or s.certify(chain), shortened
    end
    reason = chain
  end
  error(reason, 0)
end

-- The merges of a step of s.merge_log that joined two or more nodes, costliest first.
function merge_ladder.merged(step)
  local list = {}
  for _, merge in ipairs(step.merges) do
    if merge.pieces > 1 then list[#list + 1] = merge end
  end
  return list
end

-- The groups of base nodes that form a step's level, except that the merges in `left_out` are
-- undone: the nodes of the level before stay apart.
local function groups_without(chain, step, left_out)
  local finer, nodes = chain:group_map(step.from), chain:group_map(step.level)
  local sets, of = {}, {}
  for i, node in ipairs(nodes) do
    local key = left_out[node] and "finer " .. finer[i] or node
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

-- Builds the level of a step again without the costliest `fraction` of its merges. Returns the
-- model, its certificate and the number of merges left out; nil if that number is 0 or all.
function merge_ladder.without_costliest(chain, step, fraction)
  local merges = merge_ladder.merged(step)
  local count = math.floor(fraction * #merges + 0.5)
  if count == 0 or count == #merges then return nil end
  local left_out = {}
  for i = 1, count do left_out[merges[i].node] = true end
  local again = s.certify(s.simplify(chain[0], {
    levels = 1, grouping = groups_without(chain, step, left_out),
  }))
  return again[1], s.info(again).levels[2].certificate, count
end

return merge_ladder
