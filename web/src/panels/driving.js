// SPDX-License-Identifier: BSD-3-Clause
// Drives a robot: keys or a stick on the screen, velocities on a topic. The robot is stopped when the keys and the stick
// are released, when the page loses focus, and by the server when the page is silent.
import { h } from "../dom.js";

const PERIOD = 80; // ms between two commands
const KEYS = {
  w: [1, 0, 0], ArrowUp: [1, 0, 0],
  s: [-1, 0, 0], ArrowDown: [-1, 0, 0],
  a: [0, 0, 1], ArrowLeft: [0, 0, 1],
  d: [0, 0, -1], ArrowRight: [0, 0, -1],
  q: [0, 1, 0],
  e: [0, -1, 0],
}; // forward, left, turn

export const driving = {
  id: "driving",
  title: "Drive",
  place: "right",
  needsRos: true,
  create(app) {
    const topic = h("input", { value: localStorage.getItem("drive-topic") ?? "/cmd_vel", list: "drive-topics", spellcheck: false });
    const known = h("datalist", { id: "drive-topics" });
    const fastest = h("input", { type: "number", min: 0.01, max: 20, step: 0.05, value: localStorage.getItem("drive-speed") ?? 0.5 });
    const turning = h("input", { type: "number", min: 0.01, max: 20, step: 0.05, value: localStorage.getItem("drive-turn") ?? 1 });
    const on = h("button.primary.drive", { title: "Take or leave the controls" }, "Take the controls");
    const knob = h("div.knob");
    const stick = h("div.stick", { title: "Drag: forward and back, turn left and right" }, knob);
    const shown = h("p.speeds", "0.00 m/s, 0.00 rad/s");
    const nobody = h("p.warning", { hidden: true, role: "status" });
    const pressed = new Set();
    let dragged = [0, 0]; // forward, turn
    let active = false;
    let timer = null;
    let moving = false;
    let busy = false;

    const command = () => {
      let [forward, left, turn] = [dragged[0], 0, dragged[1]];
      for (const key of pressed) {
        forward += KEYS[key][0];
        left += KEYS[key][1];
        turn += KEYS[key][2];
      }
      const limit = (value) => Math.max(-1, Math.min(1, value));
      return [limit(forward) * fastest.value, limit(left) * fastest.value, limit(turn) * turning.value];
    };
    const send = async (values) => {
      shown.textContent = `${values[0].toFixed(2)} m/s, ${values[2].toFixed(2)} rad/s`;
      if (busy && values.some(Boolean)) return; // the next one is newer
      busy = true;
      try {
        await app.link.call("server.drive", [topic.value, ...values], "drive");
      } catch (error) {
        if (active) app.notify(error.message, "error");
        leave();
      } finally {
        busy = false;
      }
    };
    const tick = () => {
      const values = command();
      const wanted = values.some(Boolean);
      if (wanted || moving) send(values);
      moving = wanted;
    };
    const halt = () => {
      pressed.clear();
      dragged = [0, 0];
      knob.style.translate = "";
      if (moving) {
        moving = false;
        send([0, 0, 0]);
      }
    };
    const leave = () => {
      if (!active) return;
      active = false;
      halt();
      clearInterval(timer);
      on.textContent = "Take the controls";
      on.classList.remove("on");
      nobody.hidden = true;
      stick.classList.remove("on");
    };
    const take = async () => {
      active = true;
      on.textContent = "Leave the controls";
      on.classList.add("on");
      stick.classList.add("on");
      on.blur();
      timer = setInterval(tick, PERIOD);
      lookForSubscribers();
    };
    // Velocities without a subscriber would move nothing, without a word.
    const lookForSubscribers = async () => {
      const topics = await app.link.call("server.subscribed", [], "ros").catch(() => null);
      const names = (list) => list.map(([name]) => name).join(", ");
      nobody.hidden = !topics || topics.some(([name]) => name === topic.value);
      if (nobody.hidden) return;
      const velocities = topics.filter(([, type]) => /Twist/.test(type));
      const others = velocities.length ? `velocities are expected on ${names(velocities)}` : topics.length ? `nodes subscribe to ${names(topics)}` : "no node subscribes to any topic";
      nobody.textContent = `No subscriber on ${topic.value}: ${others}.`;
    };
    on.onclick = () => (active ? leave() : take());
    const isTyping = (event) => event.target.closest?.("input, select, textarea, .cm-editor");
    window.addEventListener(
      "keydown",
      (event) => {
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        if (!active || isTyping(event) || event.ctrlKey || event.metaKey || event.altKey) return;
        if (key === "Escape") leave();
        if (!(key in KEYS)) return;
        event.preventDefault();
        event.stopPropagation(); // no shortcut of the page
        pressed.add(key);
        if (!event.repeat) tick();
      },
      true,
    );
    window.addEventListener("keyup", (event) => {
      const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
      if (pressed.delete(key)) tick();
    }, true);
    window.addEventListener("blur", halt);
    document.addEventListener("visibilitychange", () => document.hidden && halt());
    app.link.on("connection", (connected) => !connected && leave());

    stick.addEventListener("pointerdown", (event) => {
      if (!active) take();
      stick.setPointerCapture(event.pointerId);
      const box = stick.getBoundingClientRect();
      const radius = box.width / 2;
      const move = ({ clientX, clientY }) => {
        let x = (clientX - box.left - radius) / radius;
        let y = (clientY - box.top - radius) / radius;
        const length = Math.hypot(x, y);
        if (length > 1) [x, y] = [x / length, y / length];
        knob.style.translate = `${x * radius * 0.7}px ${y * radius * 0.7}px`;
        dragged = [Math.abs(y) < 0.08 ? 0 : -y, Math.abs(x) < 0.08 ? 0 : -x];
      };
      const end = () => {
        stick.removeEventListener("pointermove", move);
        dragged = [0, 0];
        knob.style.translate = "";
        tick();
      };
      move(event);
      tick();
      stick.addEventListener("pointermove", move);
      for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) stick.addEventListener(name, end, { once: true });
    });
    topic.onfocus = async () => {
      const topics = await app.link.call("server.topics", [], "ros").catch(() => []);
      known.replaceChildren(...topics.filter(([, type]) => /Twist/.test(type)).map(([value]) => h("option", { value })));
    };
    topic.onchange = () => {
      leave();
      localStorage.setItem("drive-topic", topic.value);
    };
    fastest.onchange = () => localStorage.setItem("drive-speed", fastest.value);
    turning.onchange = () => localStorage.setItem("drive-turn", turning.value);
    return h(
      "div.driving",
      on,
      stick,
      shown,
      nobody,
      h("p.hint", h("kbd", "W"), " ", h("kbd", "S"), " or ", h("kbd", "↑"), " ", h("kbd", "↓"), " forward and back, ", h("kbd", "A"), " ", h("kbd", "D"), " turn, ", h("kbd", "Q"), " ", h("kbd", "E"), " sideways, ", h("kbd", "Esc"), " leaves."),
      h("label", "Topic", topic, known),
      h("label", "Speed (m/s)", fastest),
      h("label", "Turning (rad/s)", turning),
      h("p.hint", "The robot is stopped when you release the keys, leave the page, or lose the connection."),
    );
  },
};
