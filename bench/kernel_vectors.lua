-- Counts vector instructions per spring in the loops over springs of the measured program:
-- instructions that compute or permute lanes. Plain loads and stores do not count; 512-bit
-- instructions count twice, as many cores execute them on 256-bit units.

local kernel_vectors = {}

-- "rows/f32/AVX3" for the functions with these loops. Variants that also record damping losses are
-- not the measured ones.
local function kernel_of(header)
  local target, rest = header:match("N_(AVX%d)::%a+_forces<false(.*)$")
  if not target then return nil end
  local layout, real = rest:match("(%a+)%a*<(%a+)> const&")
  local short = {QuadBlock = "quads", QuadLayout = "quads", RowLayout = "rows"}
  if not short[layout] then return nil end
  return ("%s/%s/%s"):format(short[layout], real == "float" and "f32" or "f64", target)
end

local function is_plain_move(mnemonic, operands)
  return mnemonic:match("^vmov[au]p") or mnemonic:match("^vmovdq") or
    mnemonic:match("^vzero") or
    (mnemonic:match("^vbroadcast") or mnemonic:match("^vmov")) and operands:match("%(")
end

-- Springs per square-root instruction: its number of lanes.
local function lanes(mnemonic, operands)
  if not mnemonic:match("^vr?sqrt") then return 0 end
  local bits = operands:match("%%zmm") and 512 or operands:match("%%ymm") and 256 or 128
  return mnemonic:match("ps$") and bits / 32 or mnemonic:match("pd$") and bits / 64 or 0
end

-- The innermost loops with their counts {roots, vectors} per iteration.
local function innermost_loops(code)
  local loops = {}
  for last, jump in ipairs(code) do
    local first = jump.mnemonic:match("^j") and code.at[jump.operands:match("^%x+")]
    if first and first <= last then
      local enclosing = false
      for _, loop in ipairs(loops) do enclosing = enclosing or loop.first >= first end
      if not enclosing then loops[#loops + 1] = {first = first, last = last} end
    end
  end
  for _, loop in ipairs(loops) do
    loop.roots, loop.vectors = 0, 0
    for i = loop.first, loop.last do
      local mnemonic, operands = code[i].mnemonic, code[i].operands
      loop.roots = loop.roots + lanes(mnemonic, operands)
      if mnemonic:match("^v") and not is_plain_move(mnemonic, operands) then
        loop.vectors = loop.vectors + (operands:match("%%zmm") and 2 or 1)
      end
    end
  end
  return loops
end

-- Vector instructions per spring. Of the loops with square roots, which differ in their source of
-- damping, the smallest counts. The quad layout has further loops before and after it, with the
-- same number of springs per iteration: a pair of quads.
local function count(code, has_more_loops)
  local with_roots, without = nil, 0
  for _, loop in ipairs(innermost_loops(code)) do
    if loop.roots == 0 then
      without = without + loop.vectors
    elseif not with_roots or loop.vectors < with_roots.vectors then
      with_roots = loop
    end
  end
  if not with_roots then return nil end
  local vectors = with_roots.vectors + (has_more_loops and without or 0)
  return vectors / with_roots.roots
end

-- Returns {["rows/f32/AVX3"] = 4.2, ...}; empty without objdump.
function kernel_vectors.count(program)
  local pipe = io.popen(("objdump -dC --no-show-raw-insn '%s' 2>/dev/null"):format(program))
  local counts, kernel, code = {}, nil, nil
  for line in pipe:lines() do
    local header = line:match("^%x+ <(.*)>:$")
    if header then
      kernel, code = kernel_of(header), {at = {}}
    elseif kernel and line == "" then
      counts[kernel], kernel = count(code, kernel:match("^quads")), nil
    elseif kernel then
      local address, mnemonic, operands = line:match("^%s*(%x+):%s+(%S+)%s*(.*)$")
      if address then
        code[#code + 1] = {mnemonic = mnemonic, operands = operands}
        code.at[address] = #code
      end
    end
  end
  pipe:close()
  return counts
end

return kernel_vectors
