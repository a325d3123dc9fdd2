-- Random numbers of one throw. random.start(seed, number) must come first; the numbers after it
-- depend on both alone.

local random = {}

function random.start(seed, number) math.randomseed(seed, number) end

function random.chance(probability) return math.random() < probability end

-- An integer of low .. high.
function random.whole(low, high) return math.random(low, high) end

function random.uniform(low, high) return low + (high - low) * math.random() end

function random.log_uniform(low, high)
  return math.exp(random.uniform(math.log(low), math.log(high)))
end

function random.one_of(list) return list[math.random(#list)] end

-- A unit vector, uniform on the sphere.
function random.direction()
  local z, azimuth = random.uniform(-1, 1), random.uniform(0, 2 * math.pi)
  local across = math.sqrt(1 - z * z)
  return {across * math.cos(azimuth), across * math.sin(azimuth), z}
end

return random
