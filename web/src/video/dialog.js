// SPDX-License-Identifier: BSD-3-Clause
// "Save video": draws the run that is played back picture by picture, so that the video is smooth on any computer.
import { h } from "../dom.js";
import { download, stamp } from "../poll.js";
import { RATE, VideoEncoding } from "./encoder.js";

const SIZES = [
  [1280, 720],
  [1920, 1080],
  [640, 360],
];

export function showVideo(app) {
  const { playback, view } = app;
  const { run, time: from } = playback;
  playback.pause();
  const part = h("select", { "aria-label": "Part" }, h("option", { value: run.begin }, "the whole run"), h("option", { value: from, disabled: from >= run.end }, `from ${from.toFixed(2)} s on`));
  const size = h("select", { "aria-label": "Size" }, SIZES.map(([width, height], value) => h("option", { value }, `${width} x ${height}`)));
  const state = h("p.hint", { role: "status" }, `${RATE} pictures per second at ${playback.speed}x, from where the view is now; WebM.`);
  const bar = h("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress" });
  const save = h("button.primary", { type: "submit" }, "Save");
  let cancelled = false;
  const dialog = h(
    "dialog.saving",
    h("h2", "Save video"),
    h(
      "form",
      { method: "dialog", onsubmit: (event) => submit(event) },
      h("label", "Part", part),
      h("label", "Size", size),
      state,
      bar,
      h("div.actions", save, h("button", { type: "button", onclick: () => dialog.close() }, "Cancel")),
    ),
  );
  const submit = async (event) => {
    event.preventDefault();
    save.disabled = part.disabled = size.disabled = true;
    bar.hidden = false;
    try {
      await make(SIZES[Number(size.value)], Number(part.value));
    } catch (error) {
      app.notify(error.message, "error");
    }
    view.setSize(null);
    playback.seek(from);
    dialog.close();
  };
  const make = async ([width, height], begin) => {
    const encoding = await VideoEncoding.begin(width, height, false);
    view.setSize([width, height]);
    const pictures = Math.max(1, Math.round((RATE * (run.end - begin)) / playback.speed));
    for (let picture = 0; picture <= pictures && !cancelled; ++picture) {
      playback.seek(begin + (picture * playback.speed) / RATE);
      encoding.add(view.draw(), (1000 * picture) / RATE);
      bar.value = picture / pictures;
      state.textContent = `${picture} of ${pictures} pictures`;
      await encoding.ready();
      await new Promise((resolve) => setTimeout(resolve)); // the page answers meanwhile
    }
    if (cancelled) encoding.cancel();
    else download(`${app.scene.info?.scene ?? "scene"}_${stamp()}.webm`, await encoding.end());
  };
  dialog.addEventListener("close", () => {
    cancelled = true;
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
}
