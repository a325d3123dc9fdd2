-- Prints the constants of sim/fast/step_time.cpp that fit measured steps in flight, and the steps:
--   build/release/bench/bench_step --benchmark_filter=flight --benchmark_out=flight.json
--   springlod run bench/fit_flight.lua -- flight.json

package.path = (arg[0]:match("^(.*)/") or ".") .. "/?.lua;" .. package.path

local s = require "springlod"
local flight = require "flight"
local measurements = require "measurements"

local rows = measurements.read(arg[1], "bench_step")
table.sort(rows, function(p, q) return p.name < q.name end)
print(s.format_table(flight.fit_rows(rows), {columns = flight.fit_columns}))
print(s.format_table(flight.table_rows(rows), {columns = flight.columns}))
