-- SPDX-License-Identifier: BSD-3-Clause
-- Makes the globals of a child script in Lua: the modules of the simulator, and those parts of Lua's own libraries that
-- cannot reach outside. They stand in a table of the script's own: what the script does to its globals, metatables
-- included, does not concern the functions of C that look up Lua's own. Called by lua_code.py with
--   host.modules      by name, their constants and functions. Each function returns true, whether the thread that calls
--                     it is to give its turn back, and its results; or false and a text; or false when the script is to
--                     be broken off. So do write, find_source, explain and whole.
--   host.absent       by the names of modules that are not there, the reason
--   host.write        writes a line of output
--   host.find_source  text and name of a file that the script requires
--   host.explain      module and name: what a module has in place of a name that it does not have
--   host.whole        a text with the whole paths of the script's files
--   host.shown        what shown_values.lua returns
--   host.is_interruption  whether an error is Python's KeyboardInterrupt, which can come up between two functions, too
--   host.pulse        fails when the script is to be broken off; returns whether somebody wants to know where it is
--   host.tell_place   takes chunk and line of where it is
--   host.unsafe       whether the script may reach outside: files, processes, the insides of Lua
-- Returns the functions that lua_code.py calls.
local host = ...

local INSTRUCTIONS_BETWEEN_PULSES = 100000  -- some 0.5 ms

local error, getmetatable, load, next, pcall, rawequal, rawget, select, setmetatable, type, xpcall =
  error, getmetatable, load, next, pcall, rawequal, rawget, select, setmetatable, type, xpcall
local close, create, resume, running, status, wrap, yield = coroutine.close, coroutine.create, coroutine.resume,
  coroutine.running, coroutine.status, coroutine.wrap, coroutine.yield
local concat, format, match, max = table.concat, string.format, string.match, math.max
local getinfo, sethook, traceback = debug.getinfo, debug.sethook, debug.traceback

local SOURCE = getinfo(1, "S").source

local thread  -- the coroutine of sysCall_thread

-- Errors -------------------------------------------------------------------------------------------------------------

-- The innermost line of the script that is being run, which may have called what stands here; nil when there is none.
local function script_line()
  local level = 2
  local at = getinfo(level, "Sl")
  while at and (at.source == SOURCE or at.what == "C") do
    level = level + 1
    at = getinfo(level, "Sl")
  end
  return at
end

local function located(problem)
  local at = script_line()
  return at and format("%s:%d: %s", at.short_src, at.currentline, problem) or problem
end

local function fail(problem) error(located(problem), 0) end

-- Once a script is to be broken off, no pcall of its own keeps it alive: each that returns raises this again, until
-- the call from outside has come to its end.
local broken_off
local function break_off()
  broken_off = broken_off or located("broken off")
  error(broken_off, 0)
end

-- For an error that is about to be handled.
local function note_interruption(problem)
  if type(problem) == "userdata" and host.is_interruption(problem) then broken_off = broken_off or located("broken off") end
end

local function results_or_error(succeeded, turn_is_over_or_problem, ...)
  if not succeeded then
    if turn_is_over_or_problem == nil then break_off() end
    fail(turn_is_over_or_problem)
  end
  if turn_is_over_or_problem and running() == thread then yield() end
  return ...
end

local function checked(call)
  return function(...) return results_or_error(call(...)) end
end

local write, explain, whole = checked(host.write), checked(host.explain), checked(host.whole)

local missing = {}  -- modules, by names that a script looked for in them in vain

-- Lua's own texts name what was nil. For the modules of the simulator there is more to say.
local function explained(text)
  local where, called = match(text, "^(.-:%d+: )attempt to call a nil value %(%a+ '([%w_]+)'%)")
  if called and missing[called] then return where .. explain(missing[called], called) end
  local place, indexed = match(text, "^(.-:%d+: )attempt to index a nil value %(%a+ '([%w_]+)'%)")
  if indexed and host.absent[indexed] then return place .. host.absent[indexed] end
  return text
end

-- Whatever a script raises, as a text.
local function text_of(problem)
  if type(problem) == "string" then return explained(problem) end
  return "an error that is not a text: " .. host.shown(problem, false)
end

local thread_report  -- of the thread's error, with the calls that led there
local function report(problem)
  note_interruption(problem)
  if broken_off then return broken_off end
  if thread_report and rawequal(problem, thread_report) then return problem end
  return traceback(text_of(problem), 2)
end

-- What catches errors for the script.
local function caught(succeeded, problem, ...)
  if not succeeded then note_interruption(problem) end
  if broken_off then break_off() end
  if not succeeded and type(problem) == "string" then problem = whole(explained(problem)) end
  return succeeded, problem, ...
end

-- Pulse --------------------------------------------------------------------------------------------------------------

-- A script that loops for ever must be able to be ended: its code is interrupted now and then, in coroutines too.
local function pulse()
  local may_go_on, place_wanted = pcall(host.pulse)
  if broken_off or not may_go_on then break_off() end
  if place_wanted then
    local at = script_line()
    if at then host.tell_place(at.short_src, at.currentline) end
  end
end
local function with_pulse(body)
  return function(...)
    sethook(pulse, "", INSTRUCTIONS_BETWEEN_PULSES)
    return body(...)
  end
end
sethook(pulse, "", INSTRUCTIONS_BETWEEN_PULSES)

-- Globals ------------------------------------------------------------------------------------------------------------

local globals = _G
if not host.unsafe then
  globals = {}
  for name, value in next, _G do globals[name] = value end
  globals._G = globals
  globals.dofile, globals.io, globals.loadfile, globals.os, globals.package = nil, nil, nil, nil, nil
  getmetatable("").__metatable = false  -- all strings share it
end
globals.python = nil
globals.self = {}

function globals.pcall(...) return caught(pcall(...)) end

function globals.xpcall(body, handler, ...)
  -- While the script is being broken off, the handler would be called where nothing can interrupt it.
  return caught(xpcall(body, function(problem)
    if broken_off then return broken_off end
    return handler(type(problem) == "string" and explained(problem) or problem)
  end, ...))
end

function globals.coroutine.create(body) return create(with_pulse(body)) end
function globals.coroutine.wrap(body) return wrap(with_pulse(body)) end
function globals.coroutine.resume(...) return caught(resume(...)) end
function globals.coroutine.close(...) return caught(close(...)) end

if not host.unsafe then
  globals.debug = {
    traceback = function(...)
      local of_thread = type((...)) == "thread"
      local text, level = select(of_thread and 2 or 1, ...)
      if text ~= nil and type(text) ~= "string" and type(text) ~= "number" then return text end
      if of_thread then return whole(traceback((...), text, level)) end
      return whole(traceback(text, (level or 1) + 1))
    end,
  }

  -- A finalizer runs where nothing can interrupt it.
  function globals.setmetatable(value, metatable)
    if type(metatable) == "table" and rawget(metatable, "__gc") ~= nil then
      fail("setmetatable: there are no finalizers (__gc) in child scripts; sysCall_cleanup is called at the end")
    end
    return setmetatable(value, metatable)
  end

  -- Only texts, for binary chunks can do anything. A function that supplies the text may have been broken off.
  function globals.load(chunk, name, _, ...)
    local environment = globals
    if select("#", ...) > 0 then environment = ... end
    local loaded, problem = load(chunk, name, "t", environment)
    if broken_off then break_off() end
    return loaded, problem
  end
end

local modules = {}
for name, module in next, host.modules do
  local members = {}
  for constant, value in next, module.constants do members[constant] = value end
  for function_name, call in next, module.functions do members[function_name] = checked(call) end
  modules[name] = setmetatable(members, {
    __index = function(_, wanted) missing[wanted] = name end,
    __metatable = false,
  })
  globals[name] = members
end

-- Only the coroutine of sysCall_thread can give its turn back, not one that a script has made.
local sim = modules.sim
local function require_thread(name)
  if running() ~= thread then
    fail("sim." .. name .. " is for sysCall_thread: callbacks, and coroutines of a script's own, must not wait for the simulation")
  end
end
for _, name in next, {"step", "switchThread"} do
  local give_turn_back = sim[name]
  sim[name] = function(...)
    require_thread(name)
    return give_turn_back(...)
  end
end

-- A coroutine cannot give its turn back within a function of Python: it waits here, step by step.
function sim.wait(seconds, of_simulation)
  require_thread("wait")
  if type(seconds) ~= "number" then fail("sim.wait: argument 1, seconds: expected a number") end
  local now = of_simulation == false and sim.getSystemTime or sim.getSimulationTime
  local tolerance = of_simulation == false and 0 or 1e-6 * sim.getSimulationTimeStep()
  local end_of_wait = now() + seconds
  while now() < end_of_wait - tolerance do sim.step() end
  return max(0.0, now() - end_of_wait)
end

local find_source = checked(host.find_source)
local required = {}
function globals.require(name)
  local bare = type(name) == "string" and match(name, "^[^-]*")
  if modules[bare] then return modules[bare] end
  if host.absent[bare] then return nil end
  if required[name] == nil then
    local text, chunk_name = find_source(name)
    local chunk, problem = load(text, chunk_name, "t", globals)
    if not chunk then error(problem, 0) end
    local value = chunk(name)
    required[name] = value == nil and true or value
  end
  return required[name]
end

function globals.print(...)
  local texts = {}
  for i = 1, select("#", ...) do texts[i] = host.shown((select(i, ...)), true) end
  write(concat(texts, "\t"))
end

-- For Python ---------------------------------------------------------------------------------------------------------

local depth = 0  -- of calls from Python, which Lua may have called in turn

local function ended(succeeded, ...)
  local was_broken_off = broken_off
  depth = depth - 1
  if depth == 0 then broken_off = nil end
  if was_broken_off then return false, true, was_broken_off end
  if not succeeded then return false, false, (...) end
  return true, ...
end

return {
  -- The function of a text, or nil and what is wrong with it.
  compile = function(text, name) return load(text, name, "t", globals) end,

  -- Calls a function of the script: true and its results, or false, whether it was broken off, and the report.
  run = function(body, ...)
    depth = depth + 1
    return ended(xpcall(body, report, ...))
  end,

  global = function(name) return rawget(globals, name) end,

  -- By name the functions of the script that are global, as short_src:line.
  functions = function()
    local found = {}
    for name, value in next, globals do
      if type(name) == "string" and type(value) == "function" then
        local at = getinfo(value, "S")
        if at.what == "Lua" and at.source ~= SOURCE then found[name] = at.short_src .. ":" .. at.linedefined end
      end
    end
    return found
  end,

  -- Makes a function that lets the thread of this body go on, and returns whether it has ended.
  make_thread = function(body)
    thread = create(with_pulse(body))
    return function()
      local succeeded, problem = resume(thread)
      if not succeeded then note_interruption(problem) end
      if broken_off then break_off() end
      if not succeeded then
        thread_report = traceback(thread, text_of(problem))
        error(thread_report, 0)
      end
      return status(thread) == "dead"
    end
  end,
}
