// SPDX-License-Identifier: BSD-3-Clause
// A video of the view while it is used: what it shows, when it shows it.
import { RATE, VideoEncoding } from "./encoder.js";

const MOST = 30 * 60; // s; it is kept in the page's memory

export class LiveVideo {
  #view;
  #encoding = null;
  #off = null;
  #begin = 0; // ms
  #next = 0;
  #ended; // called when it has become too long

  constructor(view, ended) {
    this.#view = view;
    this.#ended = ended;
  }

  get runs() {
    return this.#encoding !== null;
  }

  async begin() {
    const { width, height } = this.#view.renderer.domElement;
    this.#encoding = await VideoEncoding.begin(width, height, true);
    this.#begin = performance.now();
    this.#next = 0;
    this.#off = this.#view.on("drawn", () => this.#add(false));
    this.#view.draw(); // at once: the view may turn before its next picture
  }

  /// Ends it, and returns the file as a Blob.
  end() {
    this.#off();
    this.#add(true); // the last picture may have stood for long
    const encoding = this.#encoding;
    this.#encoding = null;
    return encoding.end();
  }

  #add(last) {
    const now = performance.now() - this.#begin;
    if (!last && (now < this.#next || this.#encoding.isBusy)) return;
    this.#next = now + 1000 / RATE - 4; // the screen's rate is not quite a multiple
    this.#encoding.add(this.#view.renderer.domElement, now);
    if (!last && now > 1000 * MOST) this.#ended();
  }
}
