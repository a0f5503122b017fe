-- SPDX-License-Identifier: BSD-3-Clause
-- Makes the globals that a child script in Lua finds: the modules of the simulator, and of Lua's own libraries those
-- that cannot reach outside. Called by lua_code.py with
--   host.modules      by name, their constants and functions (each returns true, whether the thread that calls it is to
--                     give its turn back, and its results; or false and a text)
--   host.write        writes a line of output
--   host.find_source  text and name of a file that the script requires
--   host.pulse        fails when the script is to be broken off; returns whether somebody wants to know where it is
--   host.tell_place   takes chunk and line of where it is
--   host.unsafe       whether the script may reach outside: files, processes, the insides of Lua
local host = ...

local INSTRUCTIONS_BETWEEN_PULSES = 100000  -- some 0.5 ms

local error, load, pcall, select, sethook, tostring = error, load, pcall, select, debug.sethook, tostring
local create, resume, running, status, wrap, yield =
  coroutine.create, coroutine.resume, coroutine.running, coroutine.status, coroutine.wrap, coroutine.yield
local getinfo, traceback = debug.getinfo, debug.traceback

local thread  -- the coroutine of sysCall_thread

-- Blames the line that called what calls this.
local function results_or_error(succeeded, turn_is_over_or_problem, ...)
  if not succeeded then error(turn_is_over_or_problem, 2) end
  if turn_is_over_or_problem and running() == thread then yield() end
  return ...
end

local function checked(call)
  return function(...) return results_or_error(call(...)) end  -- a tail call: its caller is the script's line
end

local modules = {}
for name, module in pairs(host.modules) do
  local functions_and_constants = {}
  for constant, value in pairs(module.constants) do functions_and_constants[constant] = value end
  for function_name, call in pairs(module.functions) do functions_and_constants[function_name] = checked(call) end
  modules[name] = functions_and_constants
  _G[name] = functions_and_constants
end

-- A coroutine cannot give its turn back within a function of Python: it waits here, pass by pass.
function sim.wait(seconds, of_simulation)
  if type(seconds) ~= "number" then error("sim.wait: argument 1, seconds: expected a number", 2) end
  local now = of_simulation == false and sim.getSystemTime or sim.getSimulationTime
  local tolerance = of_simulation == false and 0 or 1e-6 * sim.getSimulationTimeStep()
  local end_of_wait = now() + seconds
  while now() < end_of_wait - tolerance do sim.step() end
  return math.max(0.0, now() - end_of_wait)
end

local loaded = {}
function require(name)
  local bare = string.match(name, "^[^-]*")
  if modules[bare] then return modules[bare] end
  if loaded[name] == nil then
    local found, problem_or_nil, text, chunk_name = host.find_source(name)
    if not found then error(problem_or_nil, 2) end
    local chunk, problem = load(text, chunk_name, "t")
    if not chunk then error(problem, 0) end
    local value = chunk(name)
    loaded[name] = value == nil and true or value
  end
  return loaded[name]
end

function print(...)
  local texts = {}
  for i = 1, select("#", ...) do texts[i] = tostring((select(i, ...))) end
  host.write(table.concat(texts, "\t"))
end

-- A script that loops for ever must be able to be ended: its code is interrupted now and then, in coroutines too.
local function pulse()
  local may_go_on, place_wanted = pcall(host.pulse)
  if may_go_on and not place_wanted then return end
  local level = 2  -- of the script's own code, which may have called what stands here
  local at = getinfo(level, "Sl")
  while at and (at.short_src == "[sandbox]" or at.what == "C") do
    level = level + 1
    at = getinfo(level, "Sl")
  end
  if not may_go_on then error("broken off", level) end
  if at then host.tell_place(at.short_src, at.currentline) end
end
local function with_pulse(body)
  return function(...)
    sethook(pulse, "", INSTRUCTIONS_BETWEEN_PULSES)
    return body(...)
  end
end
sethook(pulse, "", INSTRUCTIONS_BETWEEN_PULSES)
function coroutine.create(body) return create(with_pulse(body)) end
function coroutine.wrap(body) return wrap(with_pulse(body)) end

self = {}
python = nil
if not host.unsafe then
  dofile, io, loadfile, os, package = nil, nil, nil, nil, nil
  debug = {traceback = debug.traceback}
  function _G.load(chunk, name, _, ...) return load(chunk, name, "t", ...) end  -- binary chunks can do anything
end

-- Makes a function that lets the thread of this body go on, and returns whether it has ended.
return function(body)
  thread = create(with_pulse(body))
  return function()
    local succeeded, problem = resume(thread)
    if not succeeded then error(traceback(thread, problem), 0) end
    return status(thread) == "dead"
  end
end
