-- SPDX-License-Identifier: BSD-3-Clause
-- Converts any Lua value to text; tables with their contents. Calls no metamethods except `__tostring` if `may_call`.
-- Used by sandbox.lua.
local getmetatable, next, rawget, rawlen, tostring, type = getmetatable, next, rawget, rawlen, tostring, type
local concat, match, sort, type_of_number = table.concat, string.match, table.sort, math.type

local MAX_DEPTH, MAX_ENTRIES = 5, 100  -- nesting depth; entries of a table

local shown

local function shown_table(value, depth, above, may_call)
  if above[value] then return "{the table itself}" end
  if depth == MAX_DEPTH then return "{...}" end
  above[value] = true
  local parts, count = {}, rawlen(value)
  for i = 1, count <= MAX_ENTRIES and count or MAX_ENTRIES do parts[i] = shown(rawget(value, i), depth + 1, above, may_call) end
  local names = {}
  for key in next, value do
    if type_of_number(key) ~= "integer" or key < 1 or key > count then names[#names + 1] = key end
  end
  sort(names, function(a, b)
    local kind_a, kind_b = type(a), type(b)
    if kind_a ~= kind_b then return kind_a < kind_b end
    return (kind_a == "number" or kind_a == "string") and a < b
  end)
  for _, key in next, names do
    if #parts >= MAX_ENTRIES then break end
    local plain = type(key) == "string" and match(key, "^[%a_][%w_]*$")
    local name = plain or "[" .. shown(key, depth + 1, above, may_call) .. "]"
    parts[#parts + 1] = name .. " = " .. shown(rawget(value, key), depth + 1, above, may_call)
  end
  if count + #names > MAX_ENTRIES then parts[MAX_ENTRIES + 1] = "..." end
  above[value] = nil
  return "{" .. concat(parts, ", ") .. "}"
end

function shown(value, depth, above, may_call)
  local kind = type(value)
  if kind == "string" then return depth == 0 and value or "'" .. value .. "'" end
  if kind == "table" then
    local metatable = getmetatable(value)
    local own = type(metatable) == "table" and rawget(metatable, "__tostring") ~= nil
    if not own then return shown_table(value, depth, above, may_call) end
    if not may_call then return "a table" end
  end
  if kind == "userdata" and not may_call then return "a userdata" end
  return tostring(value)
end

return function(value, may_call) return shown(value, 0, {}, may_call) end
