-- Vectors {x, y, z}.

local vectors = {}

function vectors.minus(a, b) return {a[1] - b[1], a[2] - b[2], a[3] - b[3]} end

function vectors.cross(a, b)
  return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
end

return vectors
