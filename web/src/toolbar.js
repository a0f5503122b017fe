// SPDX-License-Identifier: BSD-3-Clause
// Play, pause, stop, step, speed, time. The buttons follow the state of the simulator, also if another client changed it.
import { showAbout } from "./about.js";
import { h } from "./dom.js";
import { icon } from "./icons.js";
import { showSaving } from "./saving.js";
import { switchTheme } from "./theme.js";

const SPEEDS = [
  [0.1, "0.1x"],
  [0.25, "0.25x"],
  [0.5, "0.5x"],
  [1, "1x"],
  [2, "2x"],
  [5, "5x"],
  [10, "10x"],
  [0, "max"],
];

export class Toolbar {
  #app;
  #shown = {};

  constructor(app) {
    this.#app = app;
    const button = (name, title, action) => h("button.tool", { title, onclick: action, "aria-label": title }, icon(name));
    this.play = button("play", "Play (Space)", () => app.attempt("window.start"));
    this.pause = button("pause", "Pause (Space)", () => app.attempt("window.pause"));
    this.stop = button("stop", "Stop: back to the start of the scene (Shift+Space)", () => app.attempt("window.stop"));
    this.step = button("step", "One step (N)", () => app.attempt("window.step", [1]));
    this.back = button("history", "Replay the last run (L)", () => this.togglePlayback());
    this.speed = h(
      "select.speed",
      { title: "Simulated seconds per second", onchange: () => app.attempt("window.speed", [Number(this.speed.value)]) },
      SPEEDS.map(([value, text]) => h("option", { value }, text)),
    );
    this.time = h("span.time", { title: "Simulation time" }, "0.00 s");
    this.factor = h("span.factor", { title: "Real-time factor: simulated seconds per second" }, "");
    this.state = h("span.state", "");
    this.title = h("span.title", "bubblesim");
    this.left = h("div.group");
    this.right = h("div.group.right");
    app.layout.toolbar.append(
      h("span.brand", icon("logo")),
      this.title,
      h("div.group", this.play, this.pause, this.stop, this.step, this.back),
      this.speed,
      this.state,
      this.time,
      this.factor,
      this.left,
      h("span.filler"),
      this.right,
    );
    this.#addViewTools(button);
    app.link.on("scene", (info) => {
      this.title.textContent = info.scene;
      this.#factors = [];
      app.link.call("window.speed").then(
        (speed) => this.#showSpeed(speed),
        () => {},
      );
    });
    app.link.on("speed", (speed) => this.#showSpeed(speed));
    app.link.on("hello", () => this.#enable());
    app.link.on("frame", (frame) => this.#follow(frame));
    app.playback.on("changed", () => this.#showPlayback());
    window.addEventListener("keydown", (event) => this.#key(event));
  }

  #factors = []; // [wall time in s, simulated s]

  /// The buttons act on the simulation, which a playback does not show.
  #enable() {
    const { link, playback } = this.#app;
    for (const each of [this.play, this.pause, this.stop, this.step, this.speed]) each.disabled = !link.mayEdit || playback.run !== null;
  }

  /// Begins to play the last run back, or ends it.
  togglePlayback() {
    const { playback, recorder, notify } = this.#app;
    const [run] = recorder.usable;
    if (playback.run) playback.end();
    else if (run) playback.begin(run);
    else notify("There is no run to replay: this page records what moves while it is open.");
  }

  #showPlayback() {
    const { playback, link, scene } = this.#app;
    this.back.classList.toggle("on", playback.run !== null);
    this.#enable();
    if (!playback.run) {
      if (link.frame) this.#follow(link.frame);
      this.showLost(!link.connected || !scene.info);
      return;
    }
    for (const each of [this.play, this.pause, this.stop]) each.classList.remove("on");
    this.#set(this.time, `${playback.time.toFixed(2)} s`);
    this.#set(this.factor, "");
    this.#set(this.state, "playback");
    this.state.dataset.state = "playback";
  }

  /// Without a simulator nothing runs, whatever the state of the last frame.
  showLost(lost) {
    if (!lost || this.#app.playback.run) return;
    this.#set(this.state, "ended");
    this.#set(this.factor, "");
    this.state.dataset.state = "ended";
    for (const each of [this.play, this.pause, this.stop]) each.classList.remove("on");
  }

  #follow(frame) {
    if (this.#app.playback.run) return;
    const { written, time, state } = frame;
    this.#set(this.time, `${time.toFixed(2)} s`);
    this.#set(this.state, state);
    this.state.dataset.state = state;
    this.play.classList.toggle("on", state === "running");
    this.pause.classList.toggle("on", state === "paused");
    this.stop.classList.toggle("on", state === "stopped");
    const samples = this.#factors;
    if (state !== "running" || (samples.length && samples.at(-1)[1] > time)) samples.length = 0;
    samples.push([written, time]);
    while (samples.length > 2 && written - samples[0][0] > 1.5) samples.shift();
    const [first] = samples;
    const factor = written > first[0] + 0.3 ? (time - first[1]) / (written - first[0]) : null;
    this.#set(this.factor, state === "running" && factor !== null ? `${factor.toFixed(factor < 9.95 ? 2 : 0)}x` : "");
  }

  #showSpeed(speed) {
    const known = [...this.speed.options].some(({ value }) => Number(value) === speed);
    if (!known) this.speed.append(h("option", { value: speed }, `${speed}x`));
    this.speed.value = String(speed);
  }

  #set(element, text) {
    if (this.#shown[element.className] === text) return;
    this.#shown[element.className] = text;
    element.textContent = text;
  }

  #addViewTools(button) {
    const { view, layout } = this.#app;
    const menu = h("div.menu", { hidden: true });
    const fill = () => {
      const entry = (title, on, action, key) =>
        h("label.entry", h("input", { type: "checkbox", checked: on, onchange: action }), h("span", title), key ? h("kbd", key) : null);
      menu.replaceChildren(
        entry("Shadows", view.shadows, () => view.setShadows(!view.shadows)),
        entry("See through walls", view.seeThrough.on, () => view.setSeeThrough(!view.seeThrough.on)),
        ...view.overlays.map((each) => entry(each.title, each.on, () => view.setOverlay(each.id, !each.on), each.key)),
      );
    };
    view.on("options", fill);
    fill();
    const opener = h("button.tool.wide", { title: "What is shown", onclick: () => (menu.hidden = !menu.hidden) }, icon("eye"), "Show");
    document.addEventListener("pointerdown", (event) => {
      if (!menu.contains(event.target) && !opener.contains(event.target)) menu.hidden = true;
    });
    const closeByKey = (event) => {
      if (event.key !== "Escape" || menu.hidden) return;
      event.stopPropagation(); // the selection stays
      menu.hidden = true;
      opener.focus();
    };
    document.addEventListener("keydown", closeByKey, true);
    const sides = h(
      "select",
      {
        title: "Look from",
        onchange: () => {
          if (sides.value === "all") view.viewpoint.lookAtAll();
          else view.viewpoint.lookFrom(sides.value);
          sides.value = "";
        },
      },
      [["", "View"], ["all", "Whole scene (Home)"], ["free", "Oblique"], ["top", "Top (7)"], ["front", "Front (1)"], ["right", "Right (3)"]].map(
        ([value, text]) => h("option", { value, hidden: value === "" }, text),
      ),
    );
    this.follow = button("follow", "Follow the selected object (F)", () => this.#toggleFollow());
    view.on("options", () => this.follow.classList.toggle("on", view.viewpoint.following !== null));
    const modes = [
      ["select", "eye2", "Select (Esc)"],
      ["move", "move", "Move (W)"],
      ["turn", "turn", "Turn (E)"],
      ["pull", "hand", "Pull a body with a spring (Q, or Ctrl and drag)"],
    ].map(([mode, name, title]) => [mode, button(name, title, () => view.gizmo.setMode(mode))]);
    this.snap = button("magnet", "Snap to 0.1 m and 15 degrees (B)", () => {
      view.gizmo.setSnapping(!view.gizmo.snapping);
      view.emit("options");
    });
    const save = button("save", "Save scene as (Ctrl+S)", () => showSaving(this.#app));
    const open = button("open", "Open a recorded run, or a scene of CoppeliaSim (Ctrl+O)", () => this.#app.files.ask());
    const { editing } = this.#app;
    this.undo = button("undo", "Undo (Ctrl+Z)", () => editing.undo());
    this.redo = button("redo", "Redo (Ctrl+Y)", () => editing.redo());
    const showEditing = () => {
      this.undo.disabled = !editing.done.length;
      this.redo.disabled = !editing.undone.length;
      this.undo.title = editing.done.length ? `Undo: ${editing.done.at(-1).title} (Ctrl+Z)` : "Undo (Ctrl+Z)";
      this.redo.title = editing.undone.length ? `Redo: ${editing.undone.at(-1).title} (Ctrl+Y)` : "Redo (Ctrl+Y)";
    };
    editing.on("changed", showEditing);
    showEditing();
    const showModes = () => {
      for (const [mode, each] of modes) each.classList.toggle("on", view.gizmo.mode === mode);
      this.snap.classList.toggle("on", view.gizmo.snapping);
    };
    view.on("options", showModes);
    showModes();
    const editTools = h("div.group", modes.map(([, each]) => each), this.snap, this.undo, this.redo, save);
    this.#app.link.on("hello", ({ edit }) => (editTools.hidden = !edit));
    this.left.append(editTools, open, sides, this.follow, h("div.dropdown", opener, menu));
    this.right.append(
      button("left", "Left panels", () => layout.toggle("left")),
      button("bottom", "Panels below", () => layout.toggle("bottom")),
      button("right", "Right panels", () => layout.toggle("right")),
      button("theme", "Light or dark", switchTheme),
      button("info", "About: shortcuts and licences (?)", () => showAbout(this.#app)),
    );
  }

  #toggleFollow() {
    const { view, selection, scene } = this.#app;
    if (view.viewpoint.following) view.viewpoint.follow(null);
    else if (selection.object) view.viewpoint.follow(followable(scene, selection.object));
    else this.#app.notify("Select an object to follow first.");
  }

  #key(event) {
    const { view, selection, link, playback } = this.#app;
    if (event.target.closest("input:not([type=range]), textarea, select, dialog, [contenteditable], .cm-editor")) return;
    if (event.key === " " && event.target.matches("button:focus-visible")) return; // it presses the button
    if ((event.ctrlKey || event.metaKey) && event.key === "s" && link.mayEdit) {
      event.preventDefault();
      showSaving(this.#app);
    }
    if ((event.ctrlKey || event.metaKey) && event.key === "o") {
      event.preventDefault();
      this.#app.files.ask();
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const actions = {
      " ": () => {
        if (playback.run && playback.plays) playback.pause();
        else if (playback.run) playback.play();
        else if (event.shiftKey) this.stop.click();
        else (link.frame?.state === "running" ? this.pause : this.play).click();
      },
      n: () => this.step.click(),
      l: () => this.togglePlayback(),
      f: () => this.#toggleFollow(),
      Home: () => view.viewpoint.lookAtAll(),
      7: () => view.viewpoint.lookFrom("top"),
      1: () => view.viewpoint.lookFrom("front"),
      3: () => view.viewpoint.lookFrom("right"),
      w: () => view.gizmo.setMode("move"),
      e: () => view.gizmo.setMode("turn"),
      q: () => view.gizmo.setMode("pull"),
      b: () => this.snap.click(),
      "?": () => showAbout(this.#app),
      Escape: () => (view.gizmo.mode === "select" ? selection.select(null) : view.gizmo.setMode("select")),
    };
    let action = actions[event.key];
    const overlay = view.overlays.find(({ key }) => key === event.key);
    if (!action && overlay) action = () => view.setOverlay(overlay.id, !overlay.on);
    if (!action) return;
    event.preventDefault();
    action();
  }
}

/// The link whose motion an object has.
function followable(scene, object) {
  return object.kind === "link" ? object : (scene.objects.get(object.carrier) ?? null);
}
