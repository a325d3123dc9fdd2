-- Small systems of linear equations.

local linear = {}

-- Solves matrix x = right by Gaussian elimination with partial pivoting, in place. Returns x, which
-- is `right`.
function linear.solve(matrix, right)
  local n = #right
  for column = 1, n do
    local pivot = column
    for row = column + 1, n do
      if math.abs(matrix[row][column]) > math.abs(matrix[pivot][column]) then pivot = row end
    end
    matrix[column], matrix[pivot] = matrix[pivot], matrix[column]
    right[column], right[pivot] = right[pivot], right[column]
    for row = column + 1, n do
      local factor = matrix[row][column] / matrix[column][column]
      for k = column, n do matrix[row][k] = matrix[row][k] - factor * matrix[column][k] end
      right[row] = right[row] - factor * right[column]
    end
  end
  for row = n, 1, -1 do
    for k = row + 1, n do right[row] = right[row] - matrix[row][k] * right[k] end
    right[row] = right[row] / matrix[row][row]
  end
  return right
end

return linear
