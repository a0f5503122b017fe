// SPDX-License-Identifier: BSD-3-Clause
// The points, and the rays, of the last scans of lidars and detections of proximity sensors.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Points, PointsMaterial } from "three";

const PERIOD = 100; // ms between two readings
const MOST_RAYS = 400;

function layer(app, make) {
  const group = new Group();
  const shown = new Map(); // handle: { holder, geometry, sensor }
  let on = false;
  let waiting = false;
  let last = -1;
  const read = async () => {
    const { link, scene, view } = app;
    if (!on || waiting || !link.frame || link.frame.time === last) return;
    waiting = true;
    last = link.frame.time;
    try {
      for (const [handle, { holder }] of shown) {
        if (scene.objects.has(handle)) continue;
        group.remove(holder);
        shown.delete(handle);
      }
      for (const sensor of scene.objects.values()) {
        if (sensor.kind !== "sensor" || !["lidar", "proximity"].includes(sensor.parameters.kind)) continue;
        const reading = await link.call("window.reading", [sensor.handle], "overlays");
        if (!shown.has(sensor.handle)) {
          const holder = make();
          holder.matrixAutoUpdate = false;
          holder.frustumCulled = false;
          group.add(holder);
          shown.set(sensor.handle, { holder, sensor });
        }
        const { holder } = shown.get(sensor.handle);
        const points = sensor.parameters.kind === "lidar" ? scanPoints(sensor.parameters, reading) : detection(reading);
        const positions = holder.isPoints ? points : rays(points);
        holder.geometry.dispose();
        holder.geometry = new BufferGeometry();
        holder.geometry.setAttribute("position", new BufferAttribute(positions, 3));
      }
      view.invalidate();
    } catch (error) {
      if (link.connected) console.debug(error.message); // a sensor that was removed meanwhile
    } finally {
      waiting = false;
    }
  };
  setInterval(read, PERIOD);
  return {
    object3d: group,
    update() {
      for (const { holder, sensor } of shown.values()) {
        app.view.matrixOf(sensor, holder.matrix);
        holder.matrixWorldNeedsUpdate = true;
      }
    },
    toggle(now) {
      on = now;
      last = -1;
    },
  };
}

/// The points of a scan in the sensor's frame.
function scanPoints({ samples, min_angle, max_angle, rings, min_elevation, max_elevation }, reading) {
  const ranges = new Float32Array(reading.ranges.slice().buffer);
  const points = [];
  const at = (from, to, count, place) => (count > 1 ? from + ((to - from) * place) / (count - 1) : from);
  for (let i = 0; i < ranges.length; ++i) {
    if (!Number.isFinite(ranges[i])) continue;
    const turn = at(min_angle, max_angle, samples, i % samples);
    const rise = at(min_elevation, max_elevation, rings, Math.floor(i / samples));
    const flat = ranges[i] * Math.cos(rise);
    points.push(flat * Math.cos(turn), flat * Math.sin(turn), ranges[i] * Math.sin(rise));
  }
  return new Float32Array(points);
}

function detection({ detected, point }) {
  return new Float32Array(detected ? point : []);
}

function rays(points) {
  const step = Math.max(1, Math.ceil(points.length / 3 / MOST_RAYS));
  const lines = [];
  for (let i = 0; i < points.length; i += 3 * step) lines.push(0, 0, 0, points[i], points[i + 1], points[i + 2]);
  return new Float32Array(lines);
}

export const lidarPoints = {
  id: "points",
  title: "Measured points",
  key: "p",
  live: true,
  on: false,
  create: (app) =>
    layer(app, () => new Points(new BufferGeometry(), new PointsMaterial({ color: 0xff3b30, size: 4, sizeAttenuation: false }))),
};

export const lidarRays = {
  id: "rays",
  title: "Measured rays",
  key: "r",
  live: true,
  on: false,
  create: (app) =>
    layer(app, () => new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: 0xff3b30, transparent: true, opacity: 0.25 }))),
};
