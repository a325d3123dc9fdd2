-- A problem as its twin with corrected bending: the caller changes its body.
return function(problem, name)
  local twin = {}
  for key, value in pairs(problem) do twin[key] = value end
  twin.name, twin.title = name, problem.title .. ", corrected bending"
  twin.text = "The same with the option `bending = \"corrected\"` of `s.lattice`."
  return twin
end
