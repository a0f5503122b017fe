// SPDX-License-Identifier: BSD-3-Clause
// The bar below the view while a recorded run is played back: its time, motion and speed, and what can be saved of it.
import { h } from "../dom.js";
import { icon } from "../icons.js";
import { download, stamp } from "../poll.js";
import { showVideo } from "../video/dialog.js";
import { runFile } from "./run_file.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];
const STEPS = 1000; // of the slider

export class PlaybackBar {
  #app;
  #runs = h("select", { "aria-label": "Recorded run", title: "Which run is played back", onchange: () => this.#choose() });
  #slider = h("input", { type: "range", min: 0, max: STEPS, step: 1, "aria-label": "Time of the playback" });
  #time = h("output.played");
  #offered = [];

  constructor(app) {
    this.#app = app;
    const { playback, recorder } = app;
    const button = (name, title, onclick) => h("button.tool", { title, "aria-label": title, onclick }, icon(name));
    this.play = button("play", "Continue the recording (Space)", () => this.#toggle());
    const speed = h(
      "select",
      { title: "Seconds of the run per second", "aria-label": "Speed of the playback", onchange: () => playback.setSpeed(Number(speed.value)) },
      SPEEDS.map((value) => h("option", { value, selected: value === 1 }, `${value}x`)),
    );
    this.element = h(
      "section.playback",
      { hidden: true, "aria-label": "Playback of a recorded run" },
      h(
        "div.line",
        h("strong", "Playback"),
        this.#runs,
        h("span.filler"),
        h("button", { title: "Save the run as a file that this window can open again", onclick: () => this.#save() }, "Save run"),
        h("button", { title: "Save a video of the run as the view shows it", onclick: () => showVideo(app) }, "Video…"),
        h("button.primary", { title: "Show the simulation again (L)", onclick: () => playback.end() }, "Back to live"),
      ),
      h(
        "div.line",
        button("first", "To the beginning", () => playback.seek(playback.run.begin)),
        button("back", "One frame back (Left)", () => playback.step(-1)),
        this.play,
        button("step", "One frame on (Right)", () => playback.step(1)),
        this.#slider,
        this.#time,
        speed,
      ),
    );
    this.#slider.oninput = () => {
      const { begin, end } = playback.run;
      playback.seek(begin + ((end - begin) * Number(this.#slider.value)) / STEPS);
    };
    playback.on("begin", () => this.#list());
    playback.on("changed", () => this.#show());
    recorder.on("changed", () => playback.run && this.#list());
    window.addEventListener("keydown", (event) => this.#key(event));
  }

  #list() {
    const { playback, recorder } = this.#app;
    this.#offered = [...new Set([playback.run, ...recorder.usable])];
    this.#runs.replaceChildren(...this.#offered.map((run, value) => h("option", { value }, `${run.name}, ${(run.end - run.begin).toFixed(1)} s`)));
  }

  #choose() {
    const run = this.#offered[Number(this.#runs.value)];
    this.#app.playback.begin(run, run.begin);
  }

  #show() {
    const { run, time, plays } = this.#app.playback;
    this.element.hidden = !run;
    if (!run) return;
    const title = plays ? "Hold the recording (Space)" : "Continue the recording (Space)";
    if (this.play.title !== title) {
      this.play.title = title;
      this.play.setAttribute("aria-label", title);
      this.play.replaceChildren(icon(plays ? "pause" : "play"));
    }
    this.#slider.value = run.end > run.begin ? (STEPS * (time - run.begin)) / (run.end - run.begin) : 0;
    this.#time.textContent = `${time.toFixed(2)} of ${run.end.toFixed(2)} s`;
    this.#slider.setAttribute("aria-valuetext", this.#time.textContent);
  }

  #toggle() {
    const { playback } = this.#app;
    if (playback.plays) playback.pause();
    else playback.play();
  }

  async #save() {
    const { playback, scene } = this.#app;
    const name = `${scene.info?.scene ?? "scene"}_${stamp()}.run`;
    try {
      download(name, await runFile(playback.run, scene));
    } catch (error) {
      this.#app.notify(error.message, "error");
    }
  }

  #key(event) {
    const { playback } = this.#app;
    const typed = event.target.closest("input:not([type=range]), textarea, select, dialog, [role=tree], [contenteditable], .cm-editor");
    if (!playback.run || typed || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "ArrowLeft") playback.step(-1);
    else if (event.key === "ArrowRight") playback.step(1);
    else return;
    event.preventDefault();
  }
}
