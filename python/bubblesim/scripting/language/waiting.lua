-- SPDX-License-Identifier: BSD-3-Clause
-- The functions of sim that wait. The coroutine of sysCall_thread, and one that the script has created, can yield its turn;
-- a coroutine cannot yield inside a Python function, so what waits does so here, step by step. Called by sandbox.lua with
--   sim           its functions, which are replaced here
--   names         of functions that take several steps: they return a number
--   go_on         carries out a step of the function with a number; returns whether it is done, and its results
--   is_thread     whether the coroutine of sysCall_thread runs
--   set_stepping  notes whether coroutines keep their turn until they yield
--   fail          raises an error at the script's line
local sim, names, go_on, is_thread, set_stepping, fail = ...

local isyieldable, yield = coroutine.isyieldable, coroutine.yield
local min, next, type = math.min, next, type

local step_of_thread, time_of = sim.step, sim.getSimulationTime
local function yield_turn(name)
  if is_thread() then return step_of_thread() end
  if not isyieldable() then
    fail("sim." .. name .. " is only allowed in sysCall_thread and in coroutines: other callbacks must not wait")
  end
  yield()
end
local function next_step(name)
  local now = time_of()
  yield_turn(name)
  while not is_thread() and time_of() == now do yield_turn(name) end  -- resumed twice in a step
end
function sim.switchThread() yield_turn("switchThread") end
function sim.step() next_step("step") end

function sim.wait(seconds, of_simulation)
  if not is_thread() and not isyieldable() then yield_turn("wait") end
  if type(seconds) ~= "number" then fail("sim.wait: argument 1, seconds: expected a number") end
  local now = of_simulation == false and sim.getSystemTime or time_of
  local tolerance = of_simulation == false and 0 or 1e-6 * sim.getSimulationTimeStep()
  local end_of_wait = now() + seconds
  while now() < end_of_wait - tolerance do next_step("wait") end
  return min(0.0, end_of_wait - now())
end

function sim.waitForSignal(name)
  if type(name) ~= "string" or not utf8.len(name) then
    fail("sim.waitForSignal: argument 1, name: expected a string, found " .. (type(name) == "string" and "bytes" or type(name)))
  end
  while true do
    local value = sim.getInt32Signal(name) or sim.getFloatSignal(name) or sim.getStringSignal(name)
    if value ~= nil then return value end
    next_step("waitForSignal")
  end
end

local read_tube = sim.tubeRead
function sim.tubeRead(tube, blocking)
  local packet = read_tube(tube, blocking)
  while packet == nil and blocking do
    next_step("tubeRead")
    packet = read_tube(tube, blocking)
  end
  return packet
end

-- Functions that take several steps: each resumption of the coroutine carries out one.
local function results_when_done(name, number, done, ...)
  if done then return ... end
  next_step(name)
  return results_when_done(name, number, go_on(number))
end
for _, name in next, names do
  local begin = sim[name]
  sim[name] = function(...)
    local number = begin(...)  -- checks the arguments
    if not is_thread() and not isyieldable() then yield_turn(name) end
    return results_when_done(name, number, go_on(number))
  end
end

for _, name in next, {"setStepping", "setThreadAutomaticSwitch", "acquireLock", "releaseLock"} do
  local set, level = sim[name], sim.getStepping
  sim[name] = function(...)
    local before = set(...)
    set_stepping(level() > 0)
    return before
  end
end
