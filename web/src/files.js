// SPDX-License-Identifier: BSD-3-Clause
// Files that are opened or dropped on the window: recorded runs, and scenes and models of CoppeliaSim.
import { h } from "./dom.js";
import { showOpening } from "./opening.js";
import { readRun } from "./playback/run_file.js";

const KINDS = [".run", ".ttt", ".ttm"];

export class Files {
  element = h("div.dropzone", { hidden: true }, "Drop a recorded run (.run), or a scene or model of CoppeliaSim (.ttt, .ttm)");
  #app;
  #input = h("input", { type: "file", accept: KINDS.join(), hidden: true, onchange: () => this.#chosen() });

  constructor(app) {
    this.#app = app;
    document.body.append(this.#input);
    const hasFiles = (event) => event.dataTransfer?.types.includes("Files");
    window.addEventListener("dragover", (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.element.hidden = false;
    });
    window.addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) this.element.hidden = true; // it has left the window
    });
    window.addEventListener("drop", (event) => {
      this.element.hidden = true;
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.open(event.dataTransfer.files[0]);
    });
  }

  /// Asks for a file.
  ask() {
    this.#input.click();
  }

  async open(file) {
    try {
      if (file.name.endsWith(".run")) await this.#play(file);
      else if (/\.tt[tm]$/.test(file.name)) await showOpening(this.#app, file);
      else throw new Error(`${file.name}: this window opens recorded runs (.run), and scenes and models of CoppeliaSim (.ttt, .ttm)`);
    } catch (error) {
      this.#app.notify(error.message, "error");
    }
  }

  async #play(file) {
    const { playback, scene, notify } = this.#app;
    const { run, missing } = await readRun(file, scene);
    if (missing.length) notify(`${missing.length} objects of ${file.name} are not in this scene: ${missing.slice(0, 5).join(", ")}`, "warning");
    playback.begin(run, run.begin);
  }

  #chosen() {
    const [file] = this.#input.files;
    this.#input.value = "";
    if (file) this.open(file);
  }
}
