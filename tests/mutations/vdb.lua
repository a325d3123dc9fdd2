-- Read many damaged .vdb files, and count what becomes of them:
--   springlod run tests/mutations/vdb.lua -- COUNT FILE...
-- COUNT may also be FIRST-LAST. Damages files of save_vdb in turn, each in another way. Every
-- second one gets the hash of its damaged bytes, so that only OpenVDB and the checks behind it can
-- find the damage. What is read becomes a lattice. Prints a row for each half: read, refused by us,
-- refused because OpenVDB crashed or did not end, and errors of any other kind and calls that take
-- long, which are bugs. Exit code 1 if there are any; their files are kept as mutant-NUMBER.vdb in
-- the current folder.

local s = require "springlod"
local mutation_run = require "mutation_run"

local kLabel = "\nspringlod content hash "
local kHashLine = #kLabel + 16
local kMostCells = 20000 -- of a grid that becomes a lattice

local function is_valid(number) return number % 2 == 0 end

local function damage(bytes, number)
  if not is_valid(number) then return mutation_run.damaged(bytes, mutation_run.damages) end
  assert(bytes:find(kLabel, -kHashLine, true), "name files that save_vdb wrote")
  local body, name = mutation_run.damaged(bytes:sub(1, -kHashLine - 1), mutation_run.damages)
  return body .. kLabel .. s.hash{text = body}, name
end

mutation_run.run{
  count = (...),
  files = {select(2, ...)},
  title = "hash",
  group = function(_, number) return is_valid(number) and "valid" or "as damaged" end,
  damage = damage,
  use = function(path)
    local grid = s.load_vdb(path)
    if grid.cell_count <= kMostCells then s.lattice(grid) end
  end,
  done = "read",
  crash = "is damaged: OpenVDB [^f]", -- "failed" is an exception
}
