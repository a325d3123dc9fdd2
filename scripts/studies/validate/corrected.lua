local twin = require "studies.validate.twin"

-- A problem as its twin with corrected bending: the caller changes its body.
return function(problem, name)
  return twin(problem, {
    name = name, title = problem.title .. ", corrected bending",
    text = "The same with the option `bending = \"corrected\"` of `s.lattice`.",
  })
end
