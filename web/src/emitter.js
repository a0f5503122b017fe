// SPDX-License-Identifier: BSD-3-Clause
// Events inside the page.

export class Emitter {
  #listeners = new Map();

  /// Calls `listener(data)` for each event of this name; returns a function that ends it.
  on(name, listener) {
    if (!this.#listeners.has(name)) this.#listeners.set(name, new Set());
    this.#listeners.get(name).add(listener);
    return () => this.#listeners.get(name).delete(listener);
  }

  emit(name, data) {
    for (const listener of [...(this.#listeners.get(name) ?? [])]) {
      try {
        listener(data);
      } catch (error) {
        console.error(error);
      }
    }
  }
}
