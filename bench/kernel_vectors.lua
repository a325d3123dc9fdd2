-- Vector instructions a spring in the loops over springs, counted in the program that was measured:
-- what computes or moves lanes about. Plain loads and stores are left out; those on 512 bits count
-- twice, for cores that work on 256.

local kernel_vectors = {}

-- "rows/f32/AVX3" for the functions that hold these loops; those that keep account of damping
-- besides are not what is measured.
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

-- Springs that one root is taken for.
local function lanes(mnemonic, operands)
  if not mnemonic:match("^vr?sqrt") then return 0 end
  local bits = operands:match("%%zmm") and 512 or operands:match("%%ymm") and 256 or 128
  return mnemonic:match("ps$") and bits / 32 or mnemonic:match("pd$") and bits / 64 or 0
end

-- The shortest loop that takes roots: vector instructions a spring.
local function count(code)
  local best
  for last, jump in ipairs(code) do
    local first = jump.mnemonic:match("^j") and code.at[jump.operands:match("^%x+")]
    if first and first <= last and (not best or last - first < best.length) then
      local springs, vectors = 0, 0
      for i = first, last do
        local mnemonic, operands = code[i].mnemonic, code[i].operands
        springs = springs + lanes(mnemonic, operands)
        if mnemonic:match("^v") and not is_plain_move(mnemonic, operands) then
          vectors = vectors + (operands:match("%%zmm") and 2 or 1)
        end
      end
      if springs > 0 then best = {length = last - first, each = vectors / springs} end
    end
  end
  return best and best.each
end

-- {["rows/f32/AVX3"] = 4.2, ...}; empty if there is no objdump.
function kernel_vectors.count(program)
  local pipe = io.popen(("objdump -dC --no-show-raw-insn '%s' 2>/dev/null"):format(program))
  local counts, kernel, code = {}, nil, nil
  for line in pipe:lines() do
    local header = line:match("^%x+ <(.*)>:$")
    if header then
      kernel, code = kernel_of(header), {at = {}}
    elseif kernel and line == "" then
      counts[kernel], kernel = count(code), nil
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
