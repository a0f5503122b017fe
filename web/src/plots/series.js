// SPDX-License-Identifier: BSD-3-Clause
// Values over time: a source adds them, a plot shows them.

const MOST = 50_000; // values; the oldest ones are dropped

export class Series {
  times = [];
  values = [];

  constructor(label, colour) {
    this.label = label;
    this.colour = colour;
  }

  /// Adds a value at a time, s. When time goes back, as after a stop, the series begins anew.
  add(time, value) {
    const last = this.times.at(-1);
    if (last !== undefined && time <= last) {
      if (time === last) return;
      this.clear();
    }
    this.times.push(time);
    this.values.push(value);
    if (this.times.length > MOST) {
      this.times.splice(0, MOST / 10);
      this.values.splice(0, MOST / 10);
    }
  }

  clear() {
    this.times = [];
    this.values = [];
  }

  /// The values of the last `seconds` until `end`: [times, values].
  part(end, seconds) {
    const from = this.#place((time) => time < end - seconds);
    const to = this.#place((time) => time <= end);
    return [this.times.slice(from, to), this.values.slice(from, to)];
  }

  /// The last value until a time; undefined if there is none.
  last(end) {
    return this.values[this.#place((time) => time <= end) - 1];
  }

  /// How many times, from the first one on, fulfil a condition.
  #place(holds) {
    let low = 0;
    let high = this.times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (holds(this.times[middle])) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

/// All series as CSV: a row for each time of any of them.
export function toCsv(series) {
  const rows = new Map();
  series.forEach(({ times, values }, column) => {
    times.forEach((time, i) => {
      if (!rows.has(time)) rows.set(time, new Array(series.length).fill(""));
      rows.get(time)[column] = Number.isNaN(values[i]) ? "" : values[i];
    });
  });
  const quoted = series.map(({ label }) => `"${label.replaceAll('"', '""')}"`);
  const body = [...rows.keys()].sort((a, b) => a - b).map((time) => [time, ...rows.get(time)].join(","));
  return `${[`"time (s)"`, ...quoted].join(",")}\n${body.join("\n")}\n`;
}
