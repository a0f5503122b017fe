// SPDX-License-Identifier: BSD-3-Clause
// The editor of child scripts. CodeMirror is loaded when the panel is shown first.
import { h } from "../dom.js";
import { Poll } from "../poll.js";
import { showCopying } from "../saving.js";

export const scripts = {
  id: "scripts",
  title: "Scripts",
  place: "bottom",
  create(app) {
    const chosen = h("select.script", { title: "The script of this object" });
    const state = h("span.state");
    const save = h("button.primary", { title: "Save the file and restart this script (Ctrl+S)" }, "Save and restart");
    const copy = h("button", { title: "This scene is a shipped one: save a copy of your own, and open it" }, "Save a copy…");
    const revert = h("button", { title: "Read the file again" }, "Revert");
    const file = h("span.file");
    const holder = h("div.editor");
    const signature = h("div.signature", { hidden: true });
    const none = h("p.hint", { hidden: true }, "This scene has no child scripts.");
    let list = [];
    let editor = null; // loaded later
    let current = null; // { handle, file, language, version, text, shipped }
    const kept = new Map(); // by handle: { state, version, saved }

    const panel = { show: () => undefined };
    const isDirty = (handle) => {
      const of = handle === current?.handle && editor ? { text: editor.text(), saved: current.text } : kept.get(handle);
      return of !== undefined && of.text !== of.saved;
    };
    const edited = () =>
      list.map(({ handle }) => handle).filter(isDirty).map((handle) => [handle, handle === current.handle ? editor.text() : kept.get(handle).text]);
    const mark = () => {
      const dirty = Boolean(current && isDirty(current.handle));
      save.classList.toggle("dirty", dirty);
      revert.disabled = !dirty;
      save.disabled = copy.disabled = !current || !app.link.mayEdit;
      copy.hidden = !current?.shipped;
      save.classList.toggle("primary", copy.hidden);
      copy.classList.toggle("primary", !copy.hidden);
      for (const option of chosen.options) {
        const each = list.find(({ handle }) => handle === Number(option.value));
        if (each) option.textContent = `${isDirty(each.handle) ? "• " : ""}${each.object}`;
      }
    };
    const showState = () => {
      const found = list.find(({ handle }) => handle === current?.handle);
      state.textContent = found?.state ?? "";
      state.dataset.state = found?.state === "failed" ? "failed" : found?.state === "running" ? "running" : "";
    };
    const refresh = async () => {
      const changes = await app.link.call("sim.getScripts", [], "log");
      const same = JSON.stringify(changes.map(({ handle }) => handle)) === JSON.stringify(list.map(({ handle }) => handle));
      list = changes;
      if (!same) {
        chosen.replaceChildren(...list.map(({ handle, object }) => h("option", { value: handle }, object)));
        if (current) chosen.value = current.handle;
      }
      none.hidden = list.length > 0;
      for (const each of [chosen, state, save, revert, file, holder]) each.hidden = !list.length;
      showState();
      mark();
      if (!list.length) return;
      const stays = current && list.some(({ handle }) => handle === current.handle);
      await open(stays ? current.handle : list[0].handle);
    };
    const runtime = () => {
      if (!editor || !current) return;
      const own = (app.problems ?? []).filter((each) => each.source === "script" && each.file === current.file);
      editor.showProblems(own.map((each) => ({ line: each.line || 1, text: each.text, level: each.level })));
    };
    const load = async () => {
      if (editor) return;
      const { Editor } = await import("../editor.js");
      const api = await app.link.call("server.api");
      editor = new Editor(holder, api, {
        changed: mark,
        save: () => run(),
        signature: (text) => {
          signature.hidden = !text;
          signature.textContent = text ?? "";
        },
        check: async (text) => (current ? app.link.call("server.checkScript", [current.handle, text], "check") : []),
      });
    };
    const choose = async (handle) => {
      if (current) kept.set(current.handle, { text: editor.text(), saved: current.text, version: current.version });
      const read = await app.link.call("server.readScript", [handle]);
      const before = kept.get(handle);
      const { file: path, language, version, text, shipped } = read;
      current = { handle, file: path, language, version, text, shipped };
      if (before && before.text !== before.saved) {
        Object.assign(current, { version: before.version, text: before.saved });
        editor.open(before.text, read.language);
      } else editor.open(read.text, read.language);
      chosen.value = handle;
      file.textContent = `\u200e${read.file}`;
      file.title = read.file;
    };
    // A file that another program has written is shown as it is now, unless there are edits here.
    const follow = async (handle) => {
      if (isDirty(handle)) return;
      const read = await app.link.call("server.readScript", [handle]);
      if (current?.handle !== handle || isDirty(handle) || read.version === current.version) return;
      Object.assign(current, { version: read.version, text: read.text });
      editor.replace(read.text);
      runtime();
    };
    const openNow = async (handle, line) => {
      await load();
      if (current?.handle === handle) await follow(handle);
      else await choose(handle).then(runtime);
      showState();
      mark();
      if (line) editor.goTo(line);
    };
    let last = Promise.resolve();
    const inOrder = (action) => { // one after the other: each awaits the server between its steps
      const done = last.then(action);
      last = done.catch(() => undefined);
      return done;
    };
    const open = (handle, line = 0) => inOrder(() => openNow(handle, line));
    const write = async (version) => {
      const text = editor.text();
      const saved = await app.link.call("server.saveScript", [current.handle, text, version], "save");
      Object.assign(current, { version: saved.version, text });
      app.notify(saved.running ? "Saved, the script was restarted" : "Saved", "info");
    };
    const run = async () => {
      if (!current || !app.link.mayEdit) return;
      try {
        await inOrder(() => write(current.version)).catch(async (error) => {
          if (!/was changed by another program/.test(error.message)) throw error;
          if (window.confirm(`${error.message}. Overwrite it?`)) await inOrder(() => write(""));
        });
        await refresh();
      } catch (error) {
        app.notify(error.message, "error");
      }
      mark();
    };
    save.onclick = () => run();
    copy.onclick = () => showCopying(app, edited());
    revert.onclick = async () => {
      const { handle } = current;
      kept.delete(handle);
      current = null;
      await open(handle).catch((error) => app.notify(error.message, "error"));
    };
    chosen.onchange = () => open(Number(chosen.value)).catch((error) => app.notify(error.message, "error"));
    app.openScript = async (object, path, line) => {
      app.layout.show("scripts");
      try {
        if (!list.length) await refresh();
        const found = list.find((each) => each.object === object);
        if (found) await open(found.handle, found.file === path ? line : 0);
      } catch (error) {
        app.notify(error.message, "error");
      }
    };
    app.link.on("problems", runtime);
    app.link.on("scene", () => {
      list = [];
      current = null;
      kept.clear();
      chosen.replaceChildren();
    });
    app.selection.on("changed", (object) => {
      const found = object && list.find((each) => each.object === object.path);
      if (found && !holder.closest("[data-panel]").hidden) open(found.handle).catch(() => undefined);
    });
    window.addEventListener("beforeunload", (event) => {
      if (list.some(({ handle }) => isDirty(handle))) event.preventDefault();
    });
    panel.poll = new Poll(app, 1000, refresh);
    this.panel = panel;
    return h("div.scripts", h("div.bar", chosen, state, copy, save, revert, file), none, holder, signature);
  },
  show() {
    this.panel.poll.start();
  },
  hide() {
    this.panel.poll.stop();
  },
};
