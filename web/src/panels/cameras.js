// SPDX-License-Identifier: BSD-3-Clause
// What the cameras of the scene see: colour and depth images.
import { h } from "../dom.js";
import { Poll } from "../poll.js";

const PERIOD = 120; // ms between two images
const SHARE = 0.1; // of the simulator's time, for images that nobody else asked for

/// Colours of depths from near (yellow) to far (violet); black beyond.
export function paintDepth(depths, near, far, pixels) {
  const low = Math.log(Math.max(near, 1e-3));
  const span = Math.log(Math.max(far, near * 1.01)) - low;
  for (let i = 0; i < depths.length; ++i) {
    const depth = depths[i];
    const t = Number.isFinite(depth) && depth < far ? Math.min(Math.max((Math.log(depth) - low) / span, 0), 1) : 2;
    const at = 4 * i;
    pixels[at] = t > 1 ? 0 : 255 * Math.max(0, Math.min(1, 1.05 - 1.3 * t + 0.55 * t * t));
    pixels[at + 1] = t > 1 ? 0 : 255 * Math.max(0, 0.93 - 0.95 * t);
    pixels[at + 2] = t > 1 ? 0 : 255 * (0.15 + 0.5 * Math.sin(Math.PI * Math.min(1, 0.15 + t)));
    pixels[at + 3] = 255;
  }
}

export function paintColour(rgb, pixels) {
  for (let i = 0, at = 0; i + 2 < rgb.length; i += 3, at += 4) {
    pixels[at] = rgb[i];
    pixels[at + 1] = rgb[i + 1];
    pixels[at + 2] = rgb[i + 2];
    pixels[at + 3] = 255;
  }
}

class Picture {
  constructor(app, object) {
    this.app = app;
    this.object = object;
    this.canvas = h("canvas");
    this.note = h("span.hint");
    this.element = h("figure.camera", this.canvas, h("figcaption", object.path, this.note));
    this.element.dataset.camera = object.path;
    const enlarge = () => this.element.setAttribute("aria-pressed", this.element.classList.toggle("large"));
    Object.assign(this.element, { onclick: enlarge, tabIndex: 0, role: "button", ariaLabel: `Enlarge ${object.path}` });
    this.element.onkeydown = (event) => event.key === "Enter" && enlarge();
  }

  /// What the camera saw then, as the page draws it; depths are not drawn.
  #replay({ time }) {
    if (this.time === `played ${time}`) return;
    this.time = `played ${time}`;
    const context = this.canvas.getContext("2d");
    if (!this.object.parameters.kind.startsWith("camera")) {
      context.clearRect(0, 0, this.canvas.width, this.canvas.height);
      this.note.textContent = " not in a playback";
      return;
    }
    const { width, height, rgba } = this.app.view.pictureFrom(this.object);
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    context.putImageData(new ImageData(rgba, width, height), 0, 0);
    this.note.textContent = ` ${width} × ${height}, playback at ${time.toFixed(2)} s`;
  }

  /// Returns the time, s, that the simulator took for it.
  async refresh() {
    if (this.app.playback.run) {
      this.#replay(this.app.playback);
      return 0;
    }
    const reading = await this.app.link.call("window.reading", [this.object.handle], "cameras");
    if (reading.time === this.time) return reading.duration;
    this.time = reading.time;
    const { width, height } = this.object.parameters;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const context = this.canvas.getContext("2d");
    const image = context.createImageData(width, height);
    if (reading.rgb) paintColour(reading.rgb, image.data);
    else if (reading.depth) {
      const depths = new Float32Array(reading.depth.slice().buffer);
      const far = Math.min(reading.far ?? Infinity, depths.reduce((m, d) => (Number.isFinite(d) && d > m ? d : m), 0.1) * 1.05);
      paintDepth(depths, reading.near ?? 0.05, far, image.data);
    }
    context.putImageData(image, 0, 0);
    this.note.textContent = ` ${width} × ${height}, ${reading.time.toFixed(2)} s`;
    return reading.duration;
  }
}

export const cameras = {
  id: "cameras",
  title: "Cameras",
  place: "bottom",
  create(app) {
    const area = h("div.camerarow");
    let pictures = [];
    const list = () => {
      pictures = [...app.scene.objects.values()]
        .filter((each) => each.kind === "sensor" && /camera/.test(each.parameters?.kind ?? ""))
        .map((each) => new Picture(app, each));
      area.replaceChildren(...pictures.map(({ element }) => element));
      if (!pictures.length) area.append(h("p.hint", "This scene has no cameras."));
    };
    app.scene.on("changed", list);
    list();
    this.poll = new Poll(app, PERIOD, async () => {
      let duration = 0;
      for (const each of pictures) duration += await each.refresh();
      return (1000 * duration) / SHARE;
    });
    return h("div.cameras", area);
  },
  show() {
    this.poll.start();
  },
  hide() {
    this.poll.stop();
  },
};
