-- The performance goals as rows {goal, limit, measured, met}. A goal whose benchmarks are missing
-- is reported as not measured.

local goals = {}

local function number(value)
  return value and (value >= 100 and "%.0f" or "%.3g"):format(value) or "not measured"
end

-- Returns the list of rows and functions that append to it; `at_most` and `at_least` compare.
local function list()
  local rows = {}
  local function add(goal, value, limit, is_met, unit)
    rows[#rows + 1] = {goal, limit, number(value) .. (value and unit or ""),
                       value and (is_met and "yes" or "no") or ""}
  end
  return rows, {
    at_most = function(goal, value, limit, unit)
      add(goal, value, "at most " .. number(limit) .. (unit or ""), value and value <= limit,
          unit or "")
    end,
    at_least = function(goal, value, limit, unit)
      add(goal, value, "at least " .. number(limit) .. (unit or ""), value and value >= limit,
          unit or "")
    end,
    reported = function(goal, value, unit)
      rows[#rows + 1] = {goal, "reported", number(value) .. (value and unit or ""), ""}
    end,
  }
end

-- Returns counter(name, key) of a benchmark, and ratio(p, q), nil if a value is missing.
local function access(by_name)
  local function counter(name, key)
    local row = by_name[name]
    return row and row.counters[key or "ns_per_spring"]
  end
  local function ratio(p, q)
    return p and q and p / q
  end
  return counter, ratio
end

local function add_kernels(to, counter, ratio)
  local function against_naive(shape, size, kernel, limit)
    local naive = counter(("step/%s/%s/naive"):format(shape, size))
    local name = ("step/%s/%s/%s"):format(shape, size, kernel)
    local goal = ("%s, %s nodes, %s: time / naive time"):format(shape, size, kernel)
    to.at_most(goal, ratio(counter(name), naive), limit)
    local avx2 = counter(name .. "/avx2")
    if avx2 then to.reported(goal .. ", AVX2", ratio(avx2, naive), "") end
  end
  for _, size in ipairs{"4k", "40k"} do
    against_naive("merged", size, "f32", 0.28)
    against_naive("merged", size, "f64", 0.6)
    against_naive("lattice", size, "f32", 0.15)
  end
  for _, shape in ipairs{"merged", "lattice"} do against_naive(shape, "300k", "f32", 0.16) end
end

local function add_bullet(to, counter, ratio)
  for _, size in ipairs{"4k", "40k"} do
    local ours = counter(("step/merged/%s/f32"):format(size))
    local function bullet(kind) return counter(("bullet/merged/%s/%s"):format(size, kind)) end
    -- The faster of the two orders of links.
    local one, each = math.huge, math.huge
    for _, order in ipairs{"", "/reordered"} do
      local first, eleven = bullet("iterations_1" .. order), bullet("iterations_11" .. order)
      if first and eleven then
        one, each = math.min(one, first), math.min(each, (eleven - first) / 10)
      end
    end
    if one == math.huge then one, each = nil, nil end
    to.at_least(("%s nodes: Bullet's position-based step with one iteration / our step")
                :format(size), ratio(one, ours), 8)
    to.at_least(("%s nodes: one additional iteration of it (a sweep) / our step")
                :format(size), ratio(each, ours), 8)
    to.at_least(("%s nodes: Bullet's explicit step / our step"):format(size),
                ratio(bullet("explicit"), ours), 35)
    to.reported(("%s nodes: the same without damping"):format(size),
                ratio(bullet("explicit_undamped"), ours), "")
  end
end

local function add_threads(to, counter, ratio)
  local function gain(name)
    return ratio(counter(name .. "/threads_1"), counter(name .. "/threads_2"))
  end
  for _, precision in ipairs{"f32", "f64"} do
    for _, shape in ipairs{"merged", "lattice"} do
      to.at_least(("%s, 40k nodes, %s: speedup of two threads"):format(shape, precision),
                  gain(("threads/%s/40k/%s"):format(shape, precision)), 1.85)
    end
  end
  for _, precision in ipairs{"f32", "f64"} do
    to.at_least(("8 starts, 4k nodes, %s: speedup of two threads"):format(precision),
                gain("ensemble/merged/4k/" .. precision), 1.9)
  end
end

local function add_jobs(to, by_name, counter, ratio)
  local rate = counter("merge_nodes/standard", "items_per_second")
  to.at_least("merging a million nodes once: million nodes per second", rate and rate / 1e6, 1)
  to.at_most("peak memory during the merge, per spring",
             counter("merge_nodes/standard", "bytes_per_spring"), 200, " bytes")
  local simplified = counter("meshoptimizer_simplify", "items_per_second")
  to.reported("merging / meshoptimizer's simplify of as many vertices, in nodes per second",
              ratio(rate, simplified), "")
  for _, body in ipairs{"sphere", "torus"} do
    to.at_most(("a %s of a million triangles in 256^3 cells: time / time of bare OpenVDB")
               :format(body), counter(("voxelize_%s_1M/threads:1"):format(body), "ratio"), 1.15)
  end
  for _, sphere in ipairs{{142, "20,000"}, {1000, "a million"}} do
    to.at_most(("importing %s triangles: more than in this process"):format(sphere[2]),
               counter(("import_sphere/sectors:%d"):format(sphere[1]), "more_ms"), 50, " ms")
  end
  local convert = by_name.convert_100k_nodes
  to.at_most("whole conversion of a mesh to an asset of 100,000 nodes", convert and convert.ms
             and convert.ms / 1e3, 3, " s")
end

-- The rows of all goals. `by_name`: measurements by name.
function goals.rows(by_name)
  local rows, to = list()
  local counter, ratio = access(by_name)
  add_kernels(to, counter, ratio)
  add_bullet(to, counter, ratio)
  add_threads(to, counter, ratio)
  add_jobs(to, by_name, counter, ratio)
  return rows
end

return goals
