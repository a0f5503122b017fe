// SPDX-License-Identifier: BSD-3-Clause
// The page. `app` is what its parts share:
//   link       calls, events and frames of the simulator (link.js)
//   scene      the objects (scene.js)
//   selection  the selected object (selection.js)
//   view       the 3D view (view/view.js)
//   recorder   the last runs (playback/recorder.js)
//   playback   shows one of them (playback/playback.js)
//   files      opens files (files.js)
//   editing    changes of the scene that can be undone (editing.js)
//   layout     show(id) brings a panel to the front
//   notify(text, level)   shows a message
//   attempt(name, args, connection)   calls a function, and shows its error as a message
import "./main.css";

import { h } from "./dom.js";
import { Editing } from "./editing.js";
import { Files } from "./files.js";
import { showFirstSteps } from "./first_steps.js";
import { Layout } from "./layout.js";
import { Link } from "./link.js";
import { Notices } from "./notices.js";
import { panels } from "./panels/index.js";
import { PlaybackBar } from "./playback/bar.js";
import { Playback } from "./playback/playback.js";
import { Recorder } from "./playback/recorder.js";
import { Scene } from "./scene.js";
import { Selection } from "./selection.js";
import { applyTheme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { View } from "./view/view.js";

applyTheme();
const link = new Link();
const scene = new Scene(link);
const selection = new Selection(scene);
const layout = new Layout();
const notices = new Notices();
const app = { link, scene, selection, layout, notify: (text, level) => notices.show(text, level) };
app.attempt = async (name, args = [], connection = "") => {
  try {
    return await link.call(name, args, connection);
  } catch (error) {
    app.notify(error.message, "error");
    return undefined;
  }
};
app.recorder = new Recorder(link, scene);
app.playback = new Playback();
app.editing = new Editing(app);
app.view = new View(app);
app.files = new Files(app);
app.toolbar = new Toolbar(app);
layout.centre.append(app.view.element);
layout.below(new PlaybackBar(app).element);
for (const panel of panels) layout.add(panel, app);

const lost = h("div.lost", { hidden: true });
const showState = () => {
  const text = !link.connected ? link.problem : scene.info ? "" : "Waiting for the simulator";
  lost.hidden = !text;
  lost.textContent = text;
  layout.centre.classList.toggle("past", Boolean(text)); // what is shown was the last picture
  app.toolbar.showLost(Boolean(text));
};
link.on("connection", showState);
link.on("problem", showState);
link.on("gone", () => {
  scene.info = null;
  showState();
});
link.on("scene", (info) => {
  document.title = `${info.scene} - bubblesim`;
  layout.showFor(info);
  showState();
});
layout.centre.append(lost, notices.element, app.files.element);
showFirstSteps(app);
document.body.append(layout.element);
showState();
link.connect();
window.bubblesim = app; // for tests and the browser's console
