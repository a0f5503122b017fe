// SPDX-License-Identifier: BSD-3-Clause
// Plots over simulated time. uPlot is loaded with the first plot.
import { h } from "../dom.js";
import { Series, toCsv } from "../plots/series.js";
import { sources } from "../plots/sources.js";
import { download, stamp } from "../poll.js";

const COLOURS = ["#3b9cff", "#ff7b54", "#39b86a", "#c678dd", "#e5b740", "#ec5f8c", "#35c0c6", "#9aa7b4"];
const PERIOD = 120; // ms between two pictures
const WINDOWS = [10, 30, 60, 300, Infinity]; // s

/// The colour of the axes, which follows the theme.
function faint() {
  return getComputedStyle(document.documentElement).getPropertyValue("--faint");
}

/// A plot with its series.
class Plot {
  series = [];
  #chart = null;
  #uPlot = null;
  #box = h("div.chart");
  #zoomed = false;
  #shown = "";

  constructor(panel, title) {
    this.panel = panel;
    this.legend = h("div.legend");
    this.element = h(
      "section.plot",
      h("header", this.legend, h("button.close", { title: "Remove this plot", onclick: () => panel.remove(this) }, "×")),
      this.#box,
    );
    this.element.dataset.plot = title;
    new ResizeObserver(() => this.#resize()).observe(this.#box);
  }

  async add(kind, chosen) {
    const colour = COLOURS[this.panel.nextColour++ % COLOURS.length];
    const series = new Series("", colour);
    const source = await sources[kind].begin(this.panel.app, chosen, (time, value) => series.add(time, value));
    series.label = source.label;
    const value = h("b.now", "-");
    const entry = h(
      "span.key",
      h("i", { style: `background:${colour}` }),
      source.label,
      value,
      h("button.close", { title: "Remove", onclick: () => this.#removeSeries(entry) }, "×"),
    );
    const known = { series, shown: series, source, entry, value, replay: (run, add) => sources[kind].replay?.(this.panel.app, chosen, run, add) };
    this.series.push(known);
    this.legend.append(entry);
    this.#choose(known);
    await this.#make();
  }

  draw(window) {
    if (!this.#chart || this.#zoomed) return;
    const { playback } = this.panel.app;
    const lasts = this.series.map(({ shown }) => shown.times.at(-1) ?? -Infinity);
    const end = playback.run ? playback.time : Math.max(...lasts);
    let size = 0;
    for (const { shown, value } of this.series) {
      size += shown.times.length;
      const last = shown.last(end);
      const text = last === undefined ? "-" : Number(last.toPrecision(4)).toString();
      if (value.textContent !== text) value.textContent = text;
    }
    const now = `${size} ${end} ${window} ${faint()}`;
    if (now === this.#shown) return;
    this.#shown = now;
    this.#setData(end, window);
  }

  /// Shows the values of the run that is played back, or those of the simulation.
  choose() {
    for (const each of this.series) this.#choose(each);
    this.follow();
  }

  /// Values that are not in frames, such as readings, are those that were collected while the last run was recorded.
  #choose(known) {
    const { playback, recorder } = this.panel.app;
    const { run } = playback;
    known.shown = known.series;
    if (!run) return;
    const replayed = new Series(known.series.label, known.series.colour);
    known.replay(run, (time, value) => replayed.add(time, value));
    if (replayed.times.length || run !== recorder.usable[0]) known.shown = replayed;
  }

  /// Shows all that follows, from now on.
  follow() {
    this.#zoomed = false;
    this.#shown = "";
  }

  end() {
    for (const { source } of this.series) source.end();
    this.#chart?.destroy();
    this.element.remove();
  }

  #setData(end, window) {
    const parts = this.series.map(({ shown }) => shown.part(end, window));
    const data = parts.length === 1 ? parts[0] : this.#uPlot.join(parts);
    this.#chart.setData(data.length ? data : [[], []]);
  }

  #removeSeries(entry) {
    const place = this.series.findIndex((each) => each.entry === entry);
    this.series[place].source.end();
    this.series.splice(place, 1);
    entry.remove();
    if (this.series.length) this.#make();
    else this.panel.remove(this);
  }

  async #make() {
    this.#uPlot ??= (await import("uplot")).default;
    this.#chart?.destroy();
    const axis = { stroke: faint, grid: { stroke: "#8883", width: 1 }, ticks: { stroke: "#8886", size: 4 }, font: "11px sans-serif" };
    this.#chart = new this.#uPlot(
      {
        ...this.#size(),
        scales: { x: { time: false } },
        axes: [{ ...axis, size: 28, values: (_, ticks) => ticks.map((each) => `${each} s`) }, { ...axis, size: 56 }],
        legend: { show: false },
        cursor: { drag: { x: true, y: false }, points: { size: 6 } },
        series: [
          {},
          ...this.series.map(({ series }) => ({ label: series.label, stroke: series.colour, width: 1.6, spanGaps: true, points: { show: false } })),
        ],
        hooks: {
          setSelect: [(chart) => (this.#zoomed = chart.select.width > 0 || this.#zoomed)],
          setCursor: [(chart) => this.#showValues(chart)],
        },
      },
      [[], ...this.series.map(() => [])],
      this.#box,
    );
    this.#box.querySelector(".u-over").addEventListener("dblclick", () => this.follow());
    this.#shown = "";
  }

  #showValues(chart) {
    const { idx } = chart.cursor;
    this.#box.title = "";
    if (idx === null || idx === undefined) return;
    const values = this.series.map(({ series }, i) => `${series.label}: ${chart.data[i + 1]?.[idx] ?? "-"}`);
    this.#box.title = [`${chart.data[0][idx]?.toFixed(3)} s`, ...values].join("\n");
  }

  #size() {
    return { width: Math.max(this.#box.clientWidth, 80), height: Math.max(this.#box.clientHeight, 60) };
  }

  #resize() {
    this.#chart?.setSize(this.#size());
  }
}

class Panel {
  plots = [];
  paused = false;
  window = 30;
  nextColour = 0;
  #timer = null;

  constructor(app) {
    this.app = app;
    this.area = h("div.plotarea", h("p.hint", "Add a joint, a pose, a sensor, a signal, a topic or a graph stream."));
    this.pause = h("button", { title: "Hold the picture; values are still collected", onclick: () => this.setPaused(!this.paused) }, "Pause");
    const window = h(
      "select",
      { title: "How much is shown", onchange: () => (this.window = Number(window.value)) },
      ...WINDOWS.map((value) => h("option", { value, selected: value === this.window }, Number.isFinite(value) ? `${value} s` : "All")),
    );
    this.form = h("form.addform", { hidden: true });
    this.element = h(
      "div.plots",
      h(
        "div.bar",
        h("button.primary", { onclick: () => this.ask() }, "Add plot…"),
        this.pause,
        window,
        h("button", { title: "Show the last values again (also: double click in a plot)", onclick: () => this.plots.forEach((each) => each.follow()) }, "Reset zoom"),
        h("button", { title: "Save all values as a table", onclick: () => this.save() }, "CSV"),
        h("span.hint", "Drag over a plot to zoom"),
      ),
      this.form,
      this.area,
    );
    const choose = () => this.plots.forEach((each) => each.choose());
    app.playback.on("begin", choose);
    app.playback.on("end", choose);
    app.plot = (kind, chosen, into) => this.add(kind, chosen, into);
  }

  start() {
    this.#timer ??= setInterval(() => {
      if (!this.paused && !document.hidden) for (const each of this.plots) each.draw(this.window);
    }, PERIOD);
  }

  stop() {
    clearInterval(this.#timer);
    this.#timer = null;
  }

  setPaused(paused) {
    this.paused = paused;
    this.pause.textContent = paused ? "Continue" : "Pause";
    this.pause.classList.toggle("on", paused);
  }

  async add(kind, chosen, into = null) {
    const plot = into ?? new Plot(this, String(this.plots.length + 1));
    try {
      await plot.add(kind, chosen);
    } catch (error) {
      this.app.notify(error.message, "error");
      return null;
    }
    if (!into) {
      this.plots.push(plot);
      this.area.querySelector(".hint")?.remove();
      this.area.append(plot.element);
    }
    return plot;
  }

  remove(plot) {
    plot.end();
    this.plots = this.plots.filter((each) => each !== plot);
  }

  save() {
    const all = this.plots.flatMap((plot) => plot.series.map(({ series }) => series));
    if (!all.length) this.app.notify("There is no plot to save", "warning");
    else download(`bubblesim_${stamp()}.csv`, toCsv(all), "text/csv");
  }

  csv() {
    return toCsv(this.plots.flatMap((plot) => plot.series.map(({ series }) => series)));
  }

  /// Asks what to plot: the kind, and then what belongs to it.
  ask() {
    const kind = h("select", { name: "kind" }, ...Object.entries(sources).map(([value, { title }]) => h("option", { value }, title)));
    const steps = h("span.steps");
    const into = h("select", { name: "into" }, h("option", { value: "" }, "New plot"), ...this.plots.map((_, i) => h("option", { value: i }, `Into plot ${i + 1}`)));
    const add = h("button.primary", { type: "submit", disabled: true }, "Add");
    let turn = 0;
    const values = () => [...steps.querySelectorAll("select, input")].map((each) => each.value);
    const next = async (count) => {
      const mine = ++turn;
      const parts = [...steps.children];
      parts.slice(count).forEach((each) => each.remove());
      add.disabled = true;
      try {
        const list = await sources[kind.value].choices(this.app, values());
        if (mine !== turn) return;
        if (!list) {
          add.disabled = false;
          return;
        }
        let input;
        if (!list.options) {
          input = h("input", { placeholder: list.label, required: true });
          input.oninput = () => (add.disabled = !input.value);
        } else if (!list.options.length) {
          steps.append(h("span.hint", `${list.label}: there is none`));
          return;
        } else {
          input = h("select", { title: list.label }, ...list.options.map((each) => h("option", { value: each.value }, each.label)));
          input.onchange = () => next([...steps.children].indexOf(input) + 1);
        }
        steps.append(input);
        if (list.options) await next(steps.children.length);
      } catch (error) {
        if (mine === turn) steps.append(h("span.hint.bad", error.message));
      }
    };
    kind.onchange = () => next(0);
    this.form.replaceChildren(kind, steps, into, add, h("button", { type: "button", onclick: () => (this.form.hidden = true) }, "Cancel"));
    this.form.onsubmit = async (event) => {
      event.preventDefault();
      this.form.hidden = true;
      await this.add(kind.value, values(), into.value === "" ? null : this.plots[Number(into.value)]);
    };
    this.form.onkeydown = (event) => event.stopPropagation();
    this.form.hidden = false;
    next(0);
  }
}

export const plots = {
  id: "plots",
  title: "Plots",
  place: "bottom",
  create(app) {
    this.panel = new Panel(app);
    app.plots = this.panel;
    return this.panel.element;
  },
  show() {
    this.panel.start();
  },
  hide() {
    this.panel.stop();
  },
};
