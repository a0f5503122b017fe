// SPDX-License-Identifier: BSD-3-Clause
// What can be plotted. A source is an object:
//   title               its name in the menu
//   choices(app)        resolves to { label, options: [{ value, label }] } lists, one after the other; each may depend on
//                       the values chosen before: choices(app, chosen) returns the next list or null
//   begin(app, chosen, add)  calls add(time, value) from now on; resolves to { label, end() }
//   replay(app, chosen, run, add)  adds the values of a recorded run (optional)
import { Matrix4, Quaternion, Vector3 } from "three";

import { Poll } from "../poll.js";

const POSE = ["x (m)", "y (m)", "z (m)", "roll (rad)", "pitch (rad)", "yaw (rad)", "speed (m/s)"];

function ofKind(app, kind) {
  return [...app.scene.objects.values()].filter((each) => each.kind === kind);
}

function paths(objects) {
  return objects.map(({ path }) => ({ value: path, label: path }));
}

/// Roll, pitch and yaw of a quaternion x, y, z, w.
export function rollPitchYaw([x, y, z, w]) {
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x)))),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

const joint = {
  title: "Joint position",
  choices: async (app, chosen) =>
    chosen.length ? null : { label: "Joint", options: paths(ofKind(app, "joint")) },
  async begin(app, [path], add) {
    const end = app.link.on("frame", (frame) => {
      const object = app.scene.byPath(path);
      const place = object && app.scene.axisIndex.get(object.handle);
      if (place !== undefined && frame.revision === app.scene.revision) add(frame.time, frame.joints[place]);
    });
    return { label: `${path} position`, end };
  },
  replay(app, [path], run, add) {
    const object = app.scene.byPath(path);
    for (const frame of object ? run.frames : []) {
      const position = run.joint(object.handle, frame);
      if (position !== undefined) add(frame.time, position);
    }
  },
};

const matrix = new Matrix4();
const place = new Vector3();
const turn = new Quaternion();

/// Returns a function of a time and a matrix that adds the value of this index in POSE.
function poseValues(index, add) {
  let before = null;
  return (time, matrix) => {
    matrix.decompose(place, turn, new Vector3());
    if (index === 6) {
      const dt = before ? time - before.time : 0;
      if (dt > 0) add(time, place.distanceTo(before.place) / dt);
      if (dt !== 0 || !before) before = { time, place: place.clone() };
      return;
    }
    const values = index < 3 ? place.toArray() : rollPitchYaw(turn.toArray());
    add(time, values[index % 3]);
  };
}

const pose = {
  title: "Pose and speed",
  choices: async (app, chosen) => {
    if (!chosen.length) return { label: "Object", options: paths([...ofKind(app, "model"), ...ofKind(app, "link")]) };
    return chosen.length === 1 ? { label: "Value", options: POSE.map((label, value) => ({ value, label })) } : null;
  },
  async begin(app, [path, index], add) {
    const take = poseValues(Number(index), add);
    const end = app.link.on("frame", (frame) => {
      const object = app.scene.byPath(path);
      if (object && frame.revision === app.scene.revision) take(frame.time, app.view.poses.latest(object, matrix));
    });
    return { label: `${path} ${POSE[index]}`, end };
  },
  replay(app, [path, index], run, add) {
    const object = app.scene.byPath(path);
    const take = poseValues(Number(index), add);
    for (const { time } of object ? run.frames : []) {
      take(time, app.view.poses.matrix(object, matrix, (link) => run.pose(link, time)));
    }
  },
};

/// The numbers of a reading by name.
export function numbersOf(reading) {
  const found = {};
  for (const [name, value] of Object.entries(reading)) {
    if (typeof value === "number" && !["time", "handle", "width", "height"].includes(name)) found[name] = value;
    else if (typeof value === "boolean") found[name] = Number(value);
    else if (Array.isArray(value) && value.every((each) => typeof each === "number")) {
      value.forEach((each, i) => (found[`${name}[${i}]`] = each));
    }
  }
  return found;
}

const sensor = {
  title: "Sensor value",
  choices: async (app, chosen) => {
    if (!chosen.length) return { label: "Sensor", options: paths(ofKind(app, "sensor")) };
    if (chosen.length > 1) return null;
    const reading = await app.link.call("window.reading", [app.scene.byPath(chosen[0]).handle], "plots");
    return { label: "Value", options: Object.keys(numbersOf(reading)).map((value) => ({ value, label: value })) };
  },
  async begin(app, [path, name], add) {
    const poll = new Poll(app, 50, async () => {
      const object = app.scene.byPath(path);
      if (!object) return;
      const reading = await app.link.call("window.reading", [object.handle], "plots");
      const value = numbersOf(reading)[name];
      if (value !== undefined) add(reading.time, value);
    });
    poll.start();
    return { label: `${path} ${name}`, end: () => poll.stop() };
  },
};

const signal = {
  title: "Signal",
  choices: async (app, chosen) => (chosen.length ? null : { label: "Name of the signal", options: null }),
  async begin(app, [name], add) {
    const poll = new Poll(app, 50, async () => {
      let value = await app.link.call("sim.getFloatSignal", [name], "plots");
      value ??= await app.link.call("sim.getInt32Signal", [name], "plots");
      if (value !== undefined && value !== null && app.link.frame) add(app.link.frame.time, value);
    });
    poll.start();
    return { label: `signal ${name}`, end: () => poll.stop() };
  },
};

const topic = {
  title: "Field of a topic",
  choices: async (app, chosen) => {
    if (!chosen.length) {
      const topics = await app.link.call("server.topics", [], "ros");
      return { label: "Topic", options: topics.map(([value, type]) => ({ value, label: `${value}  (${type})` })) };
    }
    if (chosen.length > 1) return null;
    const fields = await app.link.call("server.topicFields", [chosen[0]], "ros");
    return { label: "Field", options: fields.map((value) => ({ value, label: value })) };
  },
  async begin(app, [name, field], add) {
    let last = 0;
    let number = await app.link.call("server.watchTopic", [name, field], "ros");
    const again = app.link.on("connection", async (connected) => {
      if (!connected) return;
      last = 0;
      number = await app.link.call("server.watchTopic", [name, field], "ros").catch(() => null);
    });
    const poll = new Poll(app, 100, async () => {
      if (number === null) return;
      const changes = await app.link.call("server.topicSamples", [number, last], "ros");
      last = changes.last;
      changes.times.forEach((time, i) => add(time, changes.values[i]));
    });
    poll.start();
    return {
      label: `${name} ${field}`,
      end: () => {
        again();
        poll.stop();
        if (app.link.connected && number !== null) app.link.call("server.unwatchTopic", [number], "ros").catch(() => undefined);
      },
    };
  },
};

const graph = {
  title: "Graph stream of a script",
  choices: async (app, chosen) => {
    const { graphs } = await app.link.call("sim.getGraphs", [], "plots");
    if (!chosen.length) return { label: "Graph", options: graphs.map(({ object }) => ({ value: object, label: object })) };
    if (chosen.length > 1) return null;
    const found = graphs.find(({ object }) => object === chosen[0]);
    return { label: "Stream", options: (found?.streams ?? []).map(({ label }) => ({ value: label, label })) };
  },
  async begin(app, [object, label], add) {
    let next = 0;
    let resets = null;
    const poll = new Poll(app, 150, async () => {
      const { graphs } = await app.link.call("sim.getGraphs", [], "plots");
      const found = graphs.find((each) => each.object === object);
      const stream = found?.streams.find((each) => each.label === label);
      if (!stream) return;
      const changes = await app.link.call("sim.getGraphSamples", [found.handle, next], "plots");
      if (resets !== null && changes.resets !== resets) next = 0;
      else {
        const times = floats(changes.times);
        const values = floats(changes.streams[stream.id] ?? new Uint8Array());
        values.forEach((value, i) => Number.isNaN(value) || add(times[i], value));
        next = changes.end;
      }
      resets = changes.resets;
    });
    poll.start();
    return { label: `${object} ${label}`, end: () => poll.stop() };
  },
};

/// 64 bit floats in bytes, which need not be aligned.
export function floats(bytes) {
  return new Float64Array(bytes.slice().buffer);
}

export const sources = { joint, pose, sensor, signal, topic, graph };
