-- SPDX-License-Identifier: BSD-3-Clause
-- The module `utils`: functions for tables and strings. Called with the globals of the script.
local globals = ...
local string, table, math = globals.string, globals.table, globals.math
local utils = {}

function table.find(t, value)
  for index, each in globals.ipairs(t) do if each == value then return index end end
end
function table.join(t, separator)
  local strings = {}
  for index, each in globals.ipairs(t) do strings[index] = globals.tostring(each) end
  return table.concat(strings, separator or ", ")
end
function table.keys(t)
  local found = {}
  for key in globals.pairs(t) do found[#found + 1] = key end
  return found
end
function table.values(t)
  local found = {}
  for _, value in globals.pairs(t) do found[#found + 1] = value end
  return found
end
function table.map(action, t)
  local results = {}
  for key, value in globals.pairs(t) do results[key] = action(value) end
  return results
end
function table.filter(t, keeps)
  local found = {}
  for _, value in globals.ipairs(t) do if keeps(value) then found[#found + 1] = value end end
  return found
end
function table.slice(t, first, last, step)
  local part = {}
  for index = first or 1, last or #t, step or 1 do part[#part + 1] = t[index] end
  return part
end
function table.rep(value, count)
  local made = {}
  for index = 1, count do made[index] = value end
  return made
end
function table.range(first, last, step)
  local made = {}
  for number = first, last, step or 1 do made[#made + 1] = number end
  return made
end
function table.add(...)
  local made = {}
  for _, t in globals.ipairs({...}) do for _, value in globals.ipairs(t) do made[#made + 1] = value end end
  return made
end
function table.eq(a, b)
  if globals.type(a) ~= "table" or globals.type(b) ~= "table" then return a == b end
  for key, value in globals.pairs(a) do if not table.eq(value, b[key]) then return false end end
  for key in globals.pairs(b) do if a[key] == nil then return false end end
  return true
end
function table.clone(t)
  if globals.type(t) ~= "table" then return t end
  local made = {}
  for key, value in globals.pairs(t) do made[key] = table.clone(value) end
  return made
end
table.deepcopy = table.clone
function string.escpat(s) return (string.gsub(s, "[%^%$%(%)%%%.%[%]%*%+%-%?]", "%%%0")) end
function string.split(s, separator, is_pattern)
  local parts, from = {}, 1
  while true do
    local first, last = string.find(s, separator, from, not is_pattern)
    if not first or last < first then
      parts[#parts + 1] = string.sub(s, from)
      return parts
    end
    parts[#parts + 1], from = string.sub(s, from, first - 1), last + 1
  end
end
function string.startswith(s, begin) return string.sub(s, 1, #begin) == begin end
function string.endswith(s, ending) return ending == "" or string.sub(s, -#ending) == ending end
function string.trim(s) return (string.gsub(s, "^%s*(.-)%s*$", "%1")) end
function string.ltrim(s) return (string.gsub(s, "^%s*", "")) end
function string.rtrim(s) return (string.gsub(s, "%s*$", "")) end
function string.chars(s)
  local found = {}
  for index = 1, #s do found[index] = string.sub(s, index, index) end
  return found
end
function math.round(x, digits)
  local factor = 10 ^ (digits or 0)
  return math.floor(x * factor + 0.5) / factor
end
function math.sign(x) return x > 0 and 1 or x < 0 and -1 or 0 end
function math.hypotn(v)
  local sum = 0
  for _, each in globals.ipairs(v) do sum = sum + each * each end
  return sum ^ 0.5
end
function math.within(low, high, x) return low <= x and x <= high end
return utils
