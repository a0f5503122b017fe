-- SPDX-License-Identifier: BSD-3-Clause
-- The module `matrix`: Matrix, Vector and rotations as globals. Called with the globals of the script.
-- A matrix keeps its numbers row by row; indices count from 1.
local globals = ...
local error, getmetatable, ipairs, setmetatable, type = globals.error, globals.getmetatable, globals.ipairs,
  globals.setmetatable, globals.type
local concat, format = globals.table.concat, globals.string.format
local math = globals.math

local Matrix = {}
Matrix.__index = Matrix

local function is_matrix(value) return type(value) == "table" and getmetatable(value) == Matrix end

local function make(rows, columns, data)
  return setmetatable({_rows = rows, _cols = columns, _data = data}, Matrix)
end

local function flat(data)
  if type(data[1]) ~= "table" then return data end
  local numbers = {}
  for _, row in ipairs(data) do for _, number in ipairs(row) do numbers[#numbers + 1] = number end end
  return numbers
end

local function new(rows, columns, data)
  if is_matrix(rows) then return rows:copy() end
  if type(rows) == "table" then  -- {{1, 2}, {3, 4}}
    rows, columns, data = #rows, #rows[1], rows
  end
  local numbers = data and flat(data) or {}
  if rows == -1 then rows = #numbers // columns end
  if columns == -1 then columns = #numbers // rows end
  local made = {}
  for i = 1, rows * columns do made[i] = data and numbers[i] or 0 end
  if data and #numbers ~= rows * columns then
    error(format("a %d x %d matrix has %d numbers, found %d", rows, columns, rows * columns, #numbers), 3)
  end
  return make(rows, columns, made)
end

local function each(a, action)
  local made = {}
  for i, number in ipairs(a._data) do made[i] = action(number, i) end
  return make(a._rows, a._cols, made)
end

local function with(a, b, action)
  if type(b) == "number" then return each(a, function(x) return action(x, b) end) end
  if type(a) == "number" then return each(b, function(x) return action(a, x) end) end
  if a._rows ~= b._rows or a._cols ~= b._cols then error("the matrices have different sizes", 3) end
  return each(a, function(x, i) return action(x, b._data[i]) end)
end

function Matrix:rows() return self._rows end
function Matrix:cols() return self._cols end
function Matrix:count() return #self._data end
function Matrix:data() return each(self, function(x) return x end)._data end
function Matrix:totable()
  if self._cols == 1 then return self:data() end
  local rows = {}
  for i = 1, self._rows do rows[i] = self:rowdata(i) end
  return rows
end
function Matrix:get(i, j) return self._data[(i - 1) * self._cols + j] end
function Matrix:set(i, j, value)
  self._data[(i - 1) * self._cols + j] = value
  return self
end
function Matrix:copy() return each(self, function(x) return x end) end
function Matrix:rowdata(i)
  local row = {}
  for j = 1, self._cols do row[j] = self:get(i, j) end
  return row
end
function Matrix:coldata(j)
  local column = {}
  for i = 1, self._rows do column[i] = self:get(i, j) end
  return column
end
function Matrix:row(i) return make(1, self._cols, self:rowdata(i)) end
function Matrix:col(j) return make(self._rows, 1, self:coldata(j)) end
function Matrix:slice(first, from, last, to)
  local data = {}
  for i = first, last do for j = from, to do data[#data + 1] = self:get(i, j) end end
  return make(last - first + 1, to - from + 1, data)
end
function Matrix:t()
  local data = {}
  for j = 1, self._cols do for i = 1, self._rows do data[#data + 1] = self:get(i, j) end end
  return make(self._cols, self._rows, data)
end
function Matrix:add(b) return self + b end
function Matrix:sub(b) return self - b end
function Matrix:mult(b) return self * b end
function Matrix:times(b) return with(self, b, function(x, y) return x * y end) end
function Matrix:div(b) return with(self, b, function(x, y) return x / y end) end
function Matrix:dot(b)
  local sum = 0
  for i, number in ipairs(self._data) do sum = sum + number * b._data[i] end
  return sum
end
function Matrix:cross(b)
  local u, v = self._data, b._data
  return make(3, 1, {u[2] * v[3] - u[3] * v[2], u[3] * v[1] - u[1] * v[3], u[1] * v[2] - u[2] * v[1]})
end
function Matrix:norm() return self:dot(self) ^ 0.5 end
function Matrix:normalized() return self / self:norm() end
function Matrix:sum()
  local sum = 0
  for _, number in ipairs(self._data) do sum = sum + number end
  return sum
end
function Matrix:mean() return self:sum() / #self._data end
function Matrix:max() return math.max(globals.table.unpack(self._data)) end
function Matrix:min() return math.min(globals.table.unpack(self._data)) end
function Matrix:abs() return each(self, math.abs) end
function Matrix:applyfunc(action) return each(self, action) end

-- Gauss and Jordan's elimination with the largest pivot; also returns the determinant.
local function eliminated(a, b)
  local n = a._rows
  if n ~= a._cols then error("the matrix is not square", 3) end
  local determinant, left, right = 1, a:copy(), b:copy()
  for k = 1, n do
    local best = k
    for i = k + 1, n do if math.abs(left:get(i, k)) > math.abs(left:get(best, k)) then best = i end end
    local pivot = left:get(best, k)
    if pivot == 0 then return nil, 0 end
    if best ~= k then
      determinant = -determinant
      for _, m in ipairs({left, right}) do
        for j = 1, m._cols do
          local kept = m:get(k, j)
          m:set(k, j, m:get(best, j)):set(best, j, kept)
        end
      end
    end
    determinant = determinant * pivot
    for i = 1, n do
      local factor = left:get(i, k) / pivot
      for _, m in ipairs({right, left}) do
        for j = 1, m._cols do
          if i ~= k then m:set(i, j, m:get(i, j) - factor * m:get(k, j)) end
        end
      end
    end
  end
  for i = 1, n do for j = 1, right._cols do right:set(i, j, right:get(i, j) / left:get(i, i)) end end
  return right, determinant
end

function Matrix:det()
  local _, determinant = eliminated(self, self)
  return determinant
end
function Matrix:inv()
  local inverse = eliminated(self, Matrix.eye(self._rows))
  if not inverse then error("the matrix is singular", 2) end
  return inverse
end
function Matrix.eye(n)
  local made = new(n, n)
  for i = 1, n do made:set(i, i, 1) end
  return made
end
function Matrix.zeros(rows, columns) return new(rows, columns or rows) end
function Matrix.ones(rows, columns) return each(new(rows, columns or rows), function() return 1 end) end

Matrix.__add = function(a, b) return with(a, b, function(x, y) return x + y end) end
Matrix.__sub = function(a, b) return with(a, b, function(x, y) return x - y end) end
Matrix.__div = function(a, b) return with(a, b, function(x, y) return x / y end) end
Matrix.__unm = function(a) return each(a, function(x) return -x end) end
Matrix.__mul = function(a, b)
  if type(a) == "number" or type(b) == "number" then return with(a, b, function(x, y) return x * y end) end
  if a._cols ~= b._rows then error(format("%d columns and %d rows cannot be multiplied", a._cols, b._rows), 2) end
  local made = new(a._rows, b._cols)
  for i = 1, a._rows do
    for j = 1, b._cols do
      local sum = 0
      for k = 1, a._cols do sum = sum + a:get(i, k) * b:get(k, j) end
      made:set(i, j, sum)
    end
  end
  return made
end
Matrix.__eq = function(a, b)
  if a._rows ~= b._rows or a._cols ~= b._cols then return false end
  for i, number in ipairs(a._data) do if number ~= b._data[i] then return false end end
  return true
end
Matrix.__len = function(a) return #a._data end
Matrix.__tostring = function(a)
  local rows = {}
  for i = 1, a._rows do
    local row = {}
    for j = 1, a._cols do row[j] = globals.tostring(a:get(i, j)) end
    rows[i] = "{" .. concat(row, ", ") .. "}"
  end
  return "Matrix(" .. a._rows .. "," .. a._cols .. ",{" .. concat(rows, ", ") .. "})"
end

globals.Matrix = setmetatable({eye = Matrix.eye, zeros = Matrix.zeros, ones = Matrix.ones}, {
  __call = function(_, ...) return new(...) end,
})
globals.Matrix.ismatrix = function(_, value) return is_matrix(value) end
globals.Vector = setmetatable({}, {
  __call = function(_, data, value)
    if type(data) == "table" then return new(#data, 1, data) end
    return each(new(data, 1), function() return value or 0 end)
  end,
})
globals.Vector3 = setmetatable({}, {__call = function(_, data) return new(3, 1, data or {0, 0, 0}) end})
globals.Vector4 = setmetatable({}, {__call = function(_, data) return new(4, 1, data or {0, 0, 0, 0}) end})

local function rotation(first, second)
  return function(_, angle)
    local made, c, s = Matrix.eye(3), math.cos(angle), math.sin(angle)
    return made:set(first, first, c):set(second, second, c):set(first, second, -s):set(second, first, s)
  end
end
globals.Matrix3x3 = setmetatable({rotx = rotation(2, 3), roty = rotation(3, 1), rotz = rotation(1, 2)}, {
  __call = function(_, data) return new(3, 3, data) end,
})
globals.Matrix4x4 = setmetatable({}, {__call = function(_, data) return new(4, 4, data) end})
return globals.Matrix
