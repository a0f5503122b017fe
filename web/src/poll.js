// SPDX-License-Identifier: BSD-3-Clause
// Repeats an action while it is wanted: never twice at the same time, and not without a connection or a visible page.

export class Poll {
  #app;
  #period;
  #action;
  #on = false;
  #timer = null;
  #busy = false;
  #failed = false; // the last time

  /// `period` in ms; `action` may be asynchronous, and return a longer pause until the next turn. An error ends this turn only; the first one after a success is shown.
  constructor(app, period, action) {
    this.#app = app;
    this.#period = period;
    this.#action = action;
  }

  start() {
    if (this.#on) return;
    this.#on = true;
    this.now();
  }

  stop() {
    this.#on = false;
    clearTimeout(this.#timer);
  }

  /// Acts at once, and then again after the period.
  async now() {
    clearTimeout(this.#timer);
    if (this.#busy) return;
    this.#busy = true;
    let pause = 0;
    try {
      if (this.#app.link.connected && !document.hidden) {
        pause = (await this.#action()) ?? 0;
        this.#failed = false;
      }
    } catch (error) {
      this.#report(error);
    } finally {
      this.#busy = false;
      if (this.#on) this.#timer = setTimeout(() => this.now(), Math.max(this.#period, pause));
    }
  }

  /// Without a connection or a simulator, the page shows this, and all calls fail.
  #report(error) {
    const { link, scene } = this.#app;
    if (!link.connected || !scene.info || !this.#on || this.#failed) return;
    this.#failed = true;
    this.#app.notify(error.message, "error");
  }
}

/// Offers a string or Blob as a file.
export function download(name, content, type = "text/plain") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/// The time of day for names of files.
export function stamp() {
  return new Date().toISOString().slice(0, 19).replace(/[:T]/g, "-");
}
