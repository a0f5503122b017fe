-- SPDX-License-Identifier: BSD-3-Clause
-- The functions that CoppeliaSim's Lua has in addition to those of Lua 5.4, and the harmless parts of os, io and
-- package. Called by sandbox.lua with
--   globals    of the script
--   confined   whether the script has no access to files and processes
--   host       read_file: returns the bytes of a file beside the scene or the script, or nil and why not; getenv:
--              returns a variable; write: writes a string of output; warn: logs a warning once. Each raises an error
--              that is to be passed on.
--   fail       raises an error at the script's line
local globals, confined, host, fail = ...

local getmetatable, floor, ipairs, next, select, setmetatable, tonumber, tostring, type =
  getmetatable, math.floor, ipairs, next, select, setmetatable, tonumber, tostring, type
local concat, unpack, find, match, sub, gsub = table.concat, table.unpack, string.find, string.match, string.sub,
  string.gsub
local clock, date, difftime, time = os.clock, os.date, os.difftime, os.time

-- Lua 5.1 to 5.3 -----------------------------------------------------------------------------------------------------

local math, string, table = globals.math, globals.string, globals.table
math.atan2 = math.atan2 or math.atan
math.pow = math.pow or function(x, y) return x ^ y end
math.log10 = math.log10 or function(x) return math.log(x, 10) end
math.mod = math.mod or math.fmod
math.cosh = math.cosh or function(x) return (math.exp(x) + math.exp(-x)) / 2 end
math.sinh = math.sinh or function(x) return (math.exp(x) - math.exp(-x)) / 2 end
math.tanh = math.tanh or function(x)
  local e = math.exp(-2 * math.abs(x))
  local t = (1 - e) / (1 + e)
  return x < 0 and -t or t
end
math.ldexp = math.ldexp or function(x, exponent) return x * 2.0 ^ exponent end
math.frexp = math.frexp or function(x)
  if x == 0 or x ~= x or x == math.huge or x == -math.huge then return x, 0 end
  local exponent = floor(math.log(math.abs(x), 2)) + 1
  local mantissa = x / 2.0 ^ exponent
  if math.abs(mantissa) >= 1 then mantissa, exponent = mantissa / 2, exponent + 1 end
  if math.abs(mantissa) < 0.5 then mantissa, exponent = mantissa * 2, exponent - 1 end
  return mantissa, exponent
end
local randomseed = math.randomseed
function math.randomseed(seed, ...)
  if seed == nil then return randomseed() end
  return randomseed(math.type(seed) == "float" and floor(seed % 2 ^ 53) or seed, ...)
end
table.getn = table.getn or function(t) return #t end
table.maxn = table.maxn or function(t)
  local most = 0
  for key in next, t do if type(key) == "number" and key > most then most = key end end
  return most
end
table.foreach = table.foreach or function(t, action)
  for key, value in next, t do
    local result = action(key, value)
    if result ~= nil then return result end
  end
end
table.foreachi = table.foreachi or function(t, action)
  for index, value in ipairs(t) do
    local result = action(index, value)
    if result ~= nil then return result end
  end
end
string.gfind = string.gfind or string.gmatch
-- %d and others take numbers with a fraction, as in Lua 5.1.
local format = string.format
local function truncated(value)
  if math.type(value) ~= "float" or value ~= value or value == math.huge or value == -math.huge then return value end
  return value < 0 and -floor(-value) or floor(value)
end
function string.format(form, ...)
  local succeeded, text = globals.pcall(format, form, ...)
  if succeeded then return text end
  if not find(text, "no integer representation", 1, true) then fail(text) end
  local given, number = {...}, 0
  for letter in string.gmatch(gsub(form, "%%%%", ""), "%%[-+ #0-9.]*(%a)") do
    number = number + 1
    if find("diuxXoc", letter, 1, true) then given[number] = truncated(given[number]) end
  end
  return format(form, unpack(given, 1, select("#", ...)))
end
globals.unpack = globals.unpack or unpack
globals.loadstring = globals.loadstring or function(text, name) return globals.load(text, name) end
globals.bit32 = globals.bit32 or {
  band = function(a, b, ...) return b and globals.bit32.band(a & b, ...) or a & 0xFFFFFFFF end,
  bor = function(a, b, ...) return b and globals.bit32.bor(a | b, ...) or a & 0xFFFFFFFF end,
  bxor = function(a, b, ...) return b and globals.bit32.bxor(a ~ b, ...) or a & 0xFFFFFFFF end,
  bnot = function(a) return ~a & 0xFFFFFFFF end,
  lshift = function(a, n) return (a << n) & 0xFFFFFFFF end,
  rshift = function(a, n) return (a & 0xFFFFFFFF) >> n end,
}

-- Helpers of CoppeliaSim's own Lua files -----------------------------------------------------------------------------

function globals.printf(form, ...)
  local given = {...}
  for i = 1, select("#", ...) do
    if type(given[i]) ~= "number" then given[i] = host.shown(given[i], true) end
  end
  host.write(string.format(form, unpack(given, 1, select("#", ...))))
end
function globals.import(name, ...)
  local names, module = {...}, globals.require(name)
  if #names == 0 then globals[match(name, "^[^-]*")] = module end
  for _, each in ipairs(names) do
    if each == "*" then
      for key, value in next, module do globals[key] = value end
    else
      globals[each] = module[each]
    end
  end
end
function globals.loadPlugin(name) return globals.require(name) end
function globals.wrap(original, make) return make(original) end
function globals.isbuffer(value) return type(value) == "string" end
function globals.tobuffer(value) return tostring(value) end

function globals.getAsString(...)
  local strings = {}
  for i = 1, select("#", ...) do strings[i] = host.shown((select(i, ...)), true) end
  return concat(strings, ", ")
end

if not confined then return end

-- os, io, package ----------------------------------------------------------------------------------------------------

-- What is not allowed fails as it does for a user without permissions: scripts that only write a log go on.
local function refused(name, why)
  local reason = name .. " is not allowed in a child script: " .. why .. " (--lua-unsafe allows it)"
  return function()
    host.warn(reason)
    return nil, reason, 1
  end
end

globals.os = {
  clock = clock,
  date = date,
  difftime = difftime,
  time = time,
  getenv = function(name) return host.getenv(name) end,
  setlocale = function() return "C" end,
  execute = refused("os.execute", "start programs with sim.launchExecutable"),
  exit = function() fail("os.exit is not allowed in a child script: end the simulator with sim.quitSimulator") end,
  remove = refused("os.remove", "it changes files"),
  rename = refused("os.rename", "it changes files"),
  tmpname = function() return "/tmp/lua_" .. string.format("%06x", math.random(0, 0xffffff)) end,
}

-- A file that is read from a string.
local Reader = {}
Reader.__index = Reader
Reader.__name = "FILE*"

local function read_one(file, format)
  local text, at = file.text, file.at
  if type(format) == "number" then
    if at > #text then return nil end
    file.at = at + format
    return sub(text, at, at + format - 1)
  end
  local kind = sub(gsub(format or "l", "^%*", ""), 1, 1)
  if kind == "a" then
    file.at = #text + 1
    return sub(text, at)
  end
  if kind == "n" then
    local first, last = find(text, "^%s*[-+%w.]+", at)
    if not first then return nil end
    file.at = last + 1
    return tonumber(match(sub(text, first, last), "%S+"))
  end
  if at > #text then return nil end
  local stop = find(text, "\n", at, true) or #text + 1
  file.at = stop + 1
  return sub(text, at, kind == "L" and stop or stop - 1)
end

function Reader:read(...)
  if select("#", ...) == 0 then return read_one(self, "l") end
  local results = {}
  for i = 1, select("#", ...) do
    results[i] = read_one(self, (select(i, ...)))
    if results[i] == nil then break end
  end
  return unpack(results, 1, select("#", ...))
end
function Reader:lines(format)
  return function() return read_one(self, format or "l") end
end
function Reader:seek(whence, offset)
  local from = whence == "end" and #self.text or whence == "set" and 0 or self.at - 1
  self.at = from + (offset or 0) + 1
  return self.at - 1
end
function Reader:close() return true end
function Reader:flush() return self end
function Reader:setvbuf() return true end
function Reader:write() return self end  -- to a file that is not there

local function open(name, mode)
  if match(mode or "r", "^r[b]?$") then
    local text, problem = host.read_file(name)
    if not text then return nil, problem, 2 end
    return setmetatable({text = text, at = 1}, Reader)
  end
  host.warn("io.open: nothing is written to '" .. tostring(name) .. "': a child script reads files beside the scene, " ..
    "and changes none (--lua-unsafe allows more)")
  return setmetatable({text = "", at = 1}, Reader)
end

local output = setmetatable({text = "", at = 1, rest = ""}, Reader)
output.write = function(file, ...)
  file.rest = file.rest .. concat({...})
  local whole, rest = match(file.rest, "^(.*)\n(.-)$")
  if whole then
    host.write(whole)
    file.rest = rest
  end
  return file
end

globals.io = {
  open = open,
  lines = function(name, format)
    local file, problem = open(name)
    if not file then fail(problem) end
    return file:lines(format)
  end,
  read = function() return nil end,
  write = function(...) return output:write(...) end,
  stdout = output,
  stderr = output,
  stdin = setmetatable({text = "", at = 1}, Reader),
  close = function() return true end,
  flush = function() return output end,
  output = function() return output end,
  input = function() return globals.io.stdin end,
  type = function(value)
    return type(value) == "table" and getmetatable(value) == Reader and "file" or nil
  end,
  popen = function()
    host.warn("io.popen is not allowed in a child script: start programs with sim.launchExecutable")
    return setmetatable({text = "", at = 1}, Reader)
  end,
  tmpfile = function() return setmetatable({text = "", at = 1}, Reader) end,
}

globals.package = {path = "./?.lua", cpath = "", config = "/\n;\n?\n!\n-\n", loaded = {}, preload = {}, searchers = {}}
