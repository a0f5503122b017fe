// SPDX-License-Identifier: BSD-3-Clause
// Screenshots, videos, recorded runs, and bags of topics.
import { h } from "../dom.js";
import { Poll, download, stamp } from "../poll.js";
import { LiveVideo } from "../video/live.js";

/// The button that records what the view shows.
function videoPart(app) {
  const title = "Record what the view shows, with all turns of the camera";
  const toggle = h("button", { title }, "Record a video");
  const end = async () => {
    const file = await video.end();
    download(`${app.scene.info?.scene ?? "scene"}_${stamp()}.webm`, file);
  };
  const video = new LiveVideo(app.view, () => toggle.click());
  toggle.onclick = async () => {
    toggle.disabled = true;
    try {
      if (video.runs) await end();
      else await video.begin();
    } catch (error) {
      app.notify(error.message, "error");
    }
    toggle.disabled = false;
    toggle.textContent = video.runs ? "End the video" : "Record a video";
    toggle.classList.toggle("recording", video.runs);
  };
  return toggle;
}

/// The buttons that play recorded runs back.
function playbackPart(app) {
  return h(
    "div.bag",
    h("h3", "Runs"),
    h("button", { title: "L", onclick: () => app.toolbar.togglePlayback() }, "Replay the last run"),
    h("button", { onclick: () => app.files.ask() }, "Open a saved run…"),
    h("p.hint", "This page records the last five runs while it is open. “Save run” and “Video” are below the view during a playback."),
  );
}

export const record = {
  id: "record",
  title: "Record",
  place: "right",
  create(app) {
    const shot = h("button", { title: "Save the 3D view as a picture" }, "Take a screenshot");
    const topics = h("select", { multiple: true, size: 8, title: "Topics; none: all" });
    const toggle = h("button.primary", "Record a bag");
    const state = h("p.hint");
    let runs = false;
    shot.onclick = async () => download(`bubblesim_${stamp()}.png`, await app.view.screenshot());
    const showState = (found) => {
      runs = found.runs;
      toggle.textContent = runs ? "End the recording" : "Record a bag";
      toggle.classList.toggle("recording", runs);
      state.textContent = found.file ? `${runs ? "Recording to" : "Recorded to"} ${found.file}` : "";
      topics.disabled = runs;
    };
    toggle.onclick = async () => {
      toggle.disabled = true;
      const found = runs
        ? await app.attempt("server.stopRecording")
        : await app.attempt("server.startRecording", [[...topics.selectedOptions].map(({ value }) => value)]);
      toggle.disabled = false;
      if (found) showState(found);
    };
    this.poll = new Poll(app, 2000, async () => {
      if (bag.hidden) return;
      showState(await app.link.call("server.recording", [], "ros"));
      if (runs) return;
      const found = await app.link.call("server.topics", [], "ros").catch(() => []);
      const names = found.map(([name]) => name);
      if (names.join() === [...topics.options].map(({ value }) => value).join()) return;
      const chosen = new Set([...topics.selectedOptions].map(({ value }) => value));
      topics.replaceChildren(...names.map((value) => h("option", { value, selected: chosen.has(value) }, value)));
    });
    const bag = h(
      "div.bag",
      h("h3", "Topics"),
      topics,
      h("p.hint", "Select topics, or none to record all of them. The bag is written where the window was started."),
      toggle,
      state,
    );
    app.link.on("scene", ({ ros }) => (bag.hidden = !ros));
    return h("div.record", shot, videoPart(app), playbackPart(app), bag);
  },
  show() {
    this.poll.start();
  },
  hide() {
    this.poll.stop();
  },
};
