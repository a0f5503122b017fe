// SPDX-License-Identifier: BSD-3-Clause
// The last reading of a sensor: as numbers, as an image, or as a plot of a scan.
import { h, shortNumber } from "../../dom.js";
import { fields, numbers, section } from "./sections.js";

const PERIOD = 250; // ms between two readings

export function readingSection(app, sensor) {
  const canvas = h("canvas.reading", { hidden: true });
  const box = h("div");
  let last = -PERIOD;
  let count = -1; // of the frame then
  return {
    element: section("Last reading", canvas, box),
    async update() {
      if (app.link.frame.count === count || performance.now() - last < PERIOD) return; // an image takes the simulator a while
      last = performance.now();
      count = app.link.frame.count;
      const reading = await app.link.call("window.reading", [sensor.handle], "properties");
      if (reading.rgb || reading.depth) drawImage(canvas, { ...sensor.parameters, ...reading });
      else if (reading.ranges) drawScan(canvas, reading, sensor.parameters);
      canvas.hidden = !(reading.rgb || reading.depth || reading.ranges);
      box.replaceChildren(fields(rows(reading)));
    },
  };
}

function rows(reading) {
  const shown = [["time", `${shortNumber(reading.time, 2)} s`]];
  for (const [name, value] of Object.entries(reading)) {
    if (["type", "time", "duration", "rgb", "depth", "ranges", "intensities"].includes(name)) continue;
    if (name === "contacts") {
      shown.push(["contacts", value.length]);
      for (const contact of value.slice(0, 6)) shown.push([contact.collision, `${numbers(contact.force, 2)} N`]);
    } else if (typeof value === "number") {
      shown.push([name.replaceAll("_", " "), Number.isInteger(value) ? value : shortNumber(value)]);
    } else if (Array.isArray(value)) {
      shown.push([name.replaceAll("_", " "), numbers(value)]);
    } else if (typeof value === "boolean") {
      shown.push([name, value ? "yes" : "no"]);
    }
  }
  return shown;
}

/// Colours, or depth from near (light) to far (dark).
export function drawImage(canvas, { width, height, rgb, depth, near, far }) {
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  const picture = context.createImageData(width, height);
  const values = depth ? new Float32Array(depth.slice().buffer) : null;
  const span = values ? Math.min(far, 10) - near : 1;
  for (let pixel = 0; pixel < width * height; ++pixel) {
    if (values) {
      const shade = Number.isFinite(values[pixel]) ? 255 * (1 - Math.min(Math.max((values[pixel] - near) / span, 0), 1) * 0.9) : 0;
      picture.data.fill(shade, 4 * pixel, 4 * pixel + 3);
    } else {
      for (let i = 0; i < 3; ++i) picture.data[4 * pixel + i] = rgb[3 * pixel + i];
    }
    picture.data[4 * pixel + 3] = 255;
  }
  context.putImageData(picture, 0, 0);
}

/// The scan from above, x upwards; of several rings the middle one.
function drawScan(canvas, { ranges }, { samples, rings, min_angle, max_angle, max_range }) {
  const size = 240;
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d");
  const all = new Float32Array(ranges.slice().buffer);
  const ring = all.subarray(samples * Math.floor(rings / 2), samples * (Math.floor(rings / 2) + 1));
  let most = 0;
  for (const range of ring) if (Number.isFinite(range)) most = Math.max(most, range);
  most = Math.min(Math.max(1.1 * most, 0.5), max_range);
  const scale = size / 2 / most;
  const style = getComputedStyle(canvas);
  context.clearRect(0, 0, size, size);
  context.strokeStyle = style.getPropertyValue("--line");
  for (const part of [0.5, 1]) {
    context.beginPath();
    context.arc(size / 2, size / 2, (part * size) / 2 - 1, 0, 2 * Math.PI);
    context.stroke();
  }
  context.fillStyle = style.getPropertyValue("--faint");
  context.fillText(`${shortNumber(most, 1)} m`, size / 2 + 3, 11);
  context.fillStyle = style.getPropertyValue("--accent");
  ring.forEach((range, place) => {
    if (!Number.isFinite(range)) return;
    const angle = min_angle + (samples > 1 ? ((max_angle - min_angle) * place) / (samples - 1) : 0);
    context.fillRect(size / 2 - range * Math.sin(angle) * scale - 1, size / 2 - range * Math.cos(angle) * scale - 1, 2, 2);
  });
}
