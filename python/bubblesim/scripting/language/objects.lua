-- SPDX-License-Identifier: BSD-3-Clause
-- sim.Object, sim.self and sim.scene: objects with properties and methods. Called with the module sim, the function that
-- returns what an object has under a name, the handle of the script's object, and the function that fails.
-- Such a table holds its handle as `_object`, by which lua_values.py knows it.
local sim, member, own, fail = ...

local Object = {}

local function object(handle) return setmetatable({_object = handle}, Object) end

function Object.__index(this, name)
  local handle = rawget(this, "_object")
  if name == "handle" then return handle end
  if name == "getObject" then
    return function(_, path, options)
      local all = {}
      for key, value in next, options or {} do all[key] = value end
      if handle >= 0 then all.proxy = handle end
      local found = sim.getObject(path, all)
      if found >= 0 then return object(found) end
    end
  end
  local kind, value = member(handle, name)
  if kind == "value" then return value end
  if kind == "object" then return value >= 0 and object(value) or nil end
  if kind == "objects" then
    local all = {}
    for i, each in next, value do all[i] = object(each) end
    return all
  end
  if kind == "method" then
    return function(_, ...) return sim[value](handle, ...) end
  end
  fail("the object has neither a property nor a method '" .. tostring(name) .. "'")
end

function Object.__newindex(this, name, value) sim.setProperty(rawget(this, "_object"), name, value) end
function Object.__eq(one, other) return rawget(one, "_object") == rawget(other, "_object") end
function Object.__tostring(this) return "sim.Object('" .. sim.getObjectAlias(rawget(this, "_object"), 2) .. "')" end

function sim.Object(target) return object(type(target) == "string" and sim.getObject(target) or target) end
sim.self, sim.scene = object(own), object(sim.handle_scene)
