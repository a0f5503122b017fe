-- SPDX-License-Identifier: BSD-3-Clause
-- Creates the globals of a child script in Lua: the modules of the simulator, and the parts of Lua's libraries without
-- access to files and processes. They are in a separate table: changes of the script to its globals, including
-- metatables, do not affect C functions that use Lua's own. Called by lua_code.py with
--   host.modules      by name, their constants and functions. Each function returns true, whether the calling thread
--                     has to yield its turn, and its results; or false and an error message; or false if the script is
--                     interrupted. The same holds for write, find_source, explain and whole.
--   host.absent       by the names of modules that are not available, the reason
--   host.write        writes a line of output
--   host.find_source  returns text and name of a file that the script requires
--   host.explain      returns the error message for an unknown name of a module
--   host.old_name     returns the present name of an old name of a module, or nil
--   host.v_rep_name   returns module and name of a global of V-REP, or nil
--   host.wait         the function of waiting.lua; host.waiting and host.go_on are for it
--   host.added        by name, functions that make a module from the globals
--   host.read_file, host.getenv  see libraries.lua
--   host.objects      the function of objects.lua; host.member and host.own are for it
--   host.libraries    the function of libraries.lua
--   host.whole        returns a string with the whole paths of the script's files
--   host.shown        the function returned by shown_values.lua
--   host.is_interruption  whether an error is Python's KeyboardInterrupt, which can be raised at any time
--   host.pulse        fails if the script is interrupted; returns whether its current place is requested
--   host.report_place  receives chunk and line of the current place
--   host.unsafe       whether the script has access to files, processes and the internals of Lua
-- Returns the functions that lua_code.py calls.
local host = ...

local INSTRUCTIONS_BETWEEN_PULSES = 100000  -- about 0.5 ms

local error, getmetatable, load, next, pcall, rawequal, rawget, select, setmetatable, type, xpcall =
  error, getmetatable, load, next, pcall, rawequal, rawget, select, setmetatable, type, xpcall
local close, create, resume, running, status, wrap, yield = coroutine.close, coroutine.create, coroutine.resume,
  coroutine.running, coroutine.status, coroutine.wrap, coroutine.yield
local concat, format, match = table.concat, string.format, string.match
local clock = os.clock
local getinfo, sethook, traceback = debug.getinfo, debug.sethook, debug.traceback

local SOURCE = getinfo(1, "S").source

local thread  -- the coroutine of sysCall_thread

-- Coroutines that the script has created and resumes itself give up their turn after a time slice, as the thread does.
local SLICE = 0.002  -- s
local has_coroutines, is_stepping, slice_end = false, false, 0.0
local switched = setmetatable({}, {__mode = "k"})

-- Errors -------------------------------------------------------------------------------------------------------------

-- Returns the innermost running line of the script, which may have called functions of this file; nil without one.
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

-- After an interruption, the script's own pcalls cannot continue it: each one raises this error again, until the call
-- from Python has ended.
local interrupted
local function interrupt()
  interrupted = interrupted or located("interrupted")
  error(interrupted, 0)
end

-- Records an interruption; called for each error before it is handled.
local function note_interruption(problem)
  if type(problem) == "userdata" and host.is_interruption(problem) then
    interrupted = interrupted or located("interrupted")
  end
end

local function results_or_error(succeeded, turn_is_over_or_problem, ...)
  if not succeeded then
    if turn_is_over_or_problem == nil then interrupt() end
    fail(turn_is_over_or_problem)
  end
  if turn_is_over_or_problem and running() == thread then
    yield()
  elseif has_coroutines and not is_stepping and switched[running()] and clock() > slice_end then
    yield()
  end
  return ...
end

local function checked(call)
  return function(...) return results_or_error(call(...)) end
end

local write, explain, whole = checked(host.write), checked(host.explain), checked(host.whole)
local old_name, v_rep_name = checked(host.old_name), checked(host.v_rep_name)

local missing = {}  -- modules, by unknown names that a script has used
local reasons = {}  -- why old names have no function, which belongs to an absent module

-- Lua's error messages name the nil value. For modules of the simulator, replace them by more helpful ones.
local function explained(text)
  local where, called = match(text, "^(.-:%d+: )attempt to call a nil value %(%a+ '([%w_]+)'%)")
  if called and missing[called] ~= nil then return where .. explain(missing[called], called) end
  if called and reasons[called] then return where .. reasons[called] end
  local place, indexed = match(text, "^(.-:%d+: )attempt to index a nil value %(%a+ '([%w_]+)'%)")
  if indexed and host.absent[indexed] then return place .. host.absent[indexed] end
  return text
end

-- Returns a script's error, of any type, as a string.
local function text_of(problem)
  if type(problem) == "string" then return explained(problem) end
  return "an error that is not a string: " .. host.shown(problem, false)
end

local thread_report  -- of the thread's error, with the calls
local function report(problem)
  note_interruption(problem)
  if interrupted then return interrupted end
  if thread_report and rawequal(problem, thread_report) then return problem end
  return traceback(text_of(problem), 2)
end

-- Handles the results of the script's pcall, xpcall and similar functions.
local function caught(succeeded, problem, ...)
  if not succeeded then note_interruption(problem) end
  if interrupted then interrupt() end
  if not succeeded and type(problem) == "string" then problem = whole(explained(problem)) end
  return succeeded, problem, ...
end

-- Pulse --------------------------------------------------------------------------------------------------------------

-- Called regularly while script code runs, also in coroutines, so that endless loops can be interrupted.
local function pulse()
  local can_continue, place_requested = pcall(host.pulse)
  if interrupted or not can_continue then interrupt() end
  if place_requested then
    local at = script_line()
    if at then host.report_place(at.short_src, at.currentline) end
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
  globals.dofile, globals.loadfile = nil, nil
  getmetatable("").__metatable = false  -- shared by all strings
end
globals.python = nil
globals.self = {}

function globals.pcall(...) return caught(pcall(...)) end

function globals.xpcall(body, handler, ...)
  -- During an interruption, do not call the handler, which could not be interrupted.
  return caught(xpcall(body, function(problem)
    if interrupted then return interrupted end
    return handler(type(problem) == "string" and explained(problem) or problem)
  end, ...))
end

function globals.coroutine.create(body)
  local made = create(with_pulse(body))
  has_coroutines, switched[made] = true, true
  return made
end
function globals.coroutine.wrap(body) return wrap(with_pulse(body)) end
function globals.coroutine.resume(...)
  slice_end = clock() + SLICE
  return caught(resume(...))
end
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

  -- Finalizers could not be interrupted.
  function globals.setmetatable(value, metatable)
    if type(metatable) == "table" and rawget(metatable, "__gc") ~= nil then
      fail("setmetatable: finalizers (__gc) are not allowed in child scripts; use sysCall_cleanup")
    end
    return setmetatable(value, metatable)
  end

  -- Only strings, because binary chunks are unsafe. A function that supplies the text may have been interrupted.
  function globals.load(chunk, name, _, ...)
    local environment = globals
    if select("#", ...) > 0 then environment = ... end
    local loaded, problem = load(chunk, name, "t", environment)
    if interrupted then interrupt() end
    return loaded, problem
  end
end

local modules = {}
for name, module in next, host.modules do
  local members = {}
  for constant, value in next, module.constants do members[constant] = value end
  for function_name, call in next, module.functions do members[function_name] = checked(call) end
  modules[name] = setmetatable(members, {
    __index = function(_, wanted)
      local present = type(wanted) == "string" and old_name(name, wanted)
      if present then
        members[wanted] = members[present]
        return members[present]
      end
      missing[wanted] = name
    end,
    __metatable = false,
  })
  globals[name] = members
end

-- Functions of V-REP 3 are globals, and so are the matrices of the module `matrix`.
setmetatable(globals, {
  __index = function(_, wanted)
    if wanted == "Matrix" or wanted == "Vector" then
      globals.require("matrix")
      return rawget(globals, wanted)
    end
    if type(wanted) ~= "string" or not match(wanted, "^sim[_A-Zr]") then return nil end
    local module, present = v_rep_name(wanted)
    if not module then
      missing[wanted] = ""
      return nil
    end
    if not modules[module] then
      reasons[wanted] = host.absent[module]
      return nil
    end
    local value = modules[module][present]
    globals[wanted] = value
    return value
  end,
})

globals._S = {}  -- where CoppeliaSim's own Lua files keep their values, and some scripts theirs

local sim = modules.sim
host.wait(sim, host.waiting, checked(host.go_on), function() return running() == thread end, function(enabled)
  is_stepping = enabled
end, fail)

host.objects(sim, checked(host.member), host.own, fail)

local inverse = sim.invertMatrix
function sim.invertMatrix(matrix)  -- the argument changes, as in the original
  local inverted = inverse(matrix)
  for i, number in next, inverted do matrix[i] = number end
  return inverted
end

host.libraries(globals, not host.unsafe, {
  read_file = checked(host.read_file), getenv = checked(host.getenv), write = write, shown = host.shown,
  warn = function(text) sim.addLog(sim.verbosity_scriptwarnings | sim.verbosity_once, text) end,
}, fail)
host.added.utils(globals)

local find_source, find_included = checked(host.find_source), checked(host.find_included)
local required = {}
function globals.require(name)
  local bare = type(name) == "string" and match(name, "^[^-]*")
  if modules[bare] then return modules[bare] end
  if bare and host.added[bare] then  -- a module of the original's Lua files
    required[bare] = required[bare] or host.added[bare](globals)
    return required[bare]
  end
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

-- Old programs run other files beside their scene this way.
local function including(function_name)
  return function(name)
    if type(name) ~= "string" or not utf8.len(name) then
      fail(function_name .. ": argument 1, file: expected a string, found " .. type(name))
    end
    local text, chunk_name = find_included((match(name, "[^/\\]*$"):gsub("%.lua$", "")))
    local chunk, problem = load(text, chunk_name, "t", globals)
    if not chunk then error(problem, 0) end
    return chunk()
  end
end
sim.includeRel, sim.includeAbs = including("sim.includeRel"), including("sim.includeAbs")

function globals.print(...)
  local strings = {}
  for i = 1, select("#", ...) do strings[i] = host.shown((select(i, ...)), true) end
  write(concat(strings, "\t"))
end

-- For Python ---------------------------------------------------------------------------------------------------------

local depth = 0  -- of nested calls from Python

local function ended(succeeded, ...)
  local was_interrupted = interrupted
  depth = depth - 1
  if depth == 0 then interrupted = nil end
  if was_interrupted then return false, true, was_interrupted end
  if not succeeded then return false, false, (...) end
  return true, ...
end

return {
  -- Returns the function compiled from a string, or nil and the error message.
  compile = function(text, name) return load(text, name, "t", globals) end,

  -- Calls a function of the script; returns true and its results, or false, whether it was interrupted, and a report.
  run = function(body, ...)
    depth = depth + 1
    return ended(xpcall(body, report, ...))
  end,

  global = function(name) return rawget(globals, name) end,

  -- Lets a script of V-REP 3, whose whole text is called, have the callbacks of today: those of each step, and of the
  -- others those with a number in `more`.
  make_callbacks = function(body, more)
    local names = {[0] = "sysCall_init", "sysCall_actuation", "sysCall_sensing", "sysCall_cleanup",
      "sysCall_beforeSimulation", "sysCall_afterSimulation", "sysCall_suspend", "sysCall_suspended", "sysCall_resume"}
    for call, name in next, names do
      if call < 4 or more[call] then
        globals[name] = function()
          globals.sim_call_type = call
          return body()
        end
      end
    end
  end,

  -- The same for a thread of V-REP 3, and for a script of V-REP 2, which is called in each step.
  make_old_thread = function(body) globals.sysCall_thread = body end,
  make_step = function(body)
    globals.sysCall_init = function() end
    globals.sysCall_actuation = body
  end,

  -- Returns the global functions of the script by name, as short_src:line.
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

  -- Returns a function that resumes the thread with this body, and returns whether it has ended.
  make_thread = function(body)
    thread = create(with_pulse(body))
    return function()
      local succeeded, problem = resume(thread)
      if not succeeded then note_interruption(problem) end
      if interrupted then interrupt() end
      if not succeeded then
        thread_report = traceback(thread, text_of(problem))
        error(thread_report, 0)
      end
      return status(thread) == "dead"
    end
  end,
}
