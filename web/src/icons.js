// SPDX-License-Identifier: BSD-3-Clause
// Icons of 16 x 16 as paths.
const PATHS = {
  play: '<path d="M4 2.5v11l9-5.5z" fill="currentColor"/>',
  pause: '<path d="M4 3h3v10H4zM9 3h3v10H9z" fill="currentColor"/>',
  stop: '<path d="M3.5 3.5h9v9h-9z" fill="currentColor"/>',
  step: '<path d="M3 3v10l7-5zM11 3h2v10h-2z" fill="currentColor"/>',
  history: '<path d="M2.5 8a5.5 5.5 0 1 0 1.8-4.1L2.5 5.5M2.5 2.5v3h3M8 5v3.3l2.3 1.5"/>',
  first: '<path d="M3 3v10M13 3v10L5.5 8z" fill="currentColor"/>',
  back: '<path d="M13 3v10L6 8zM3 3h2v10H3z" fill="currentColor"/>',
  eye: '<path d="M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8z"/><circle cx="8" cy="8" r="2"/>',
  eye2: '<path d="M3 2l9.5 5.2-4.2 1.1L11 13l-1.8 1-2.7-4.6L3.5 12z"/>',
  follow: '<circle cx="8" cy="8" r="4.5"/><path d="M8 1v4M8 11v4M1 8h4M11 8h4"/>',
  left: '<rect x="1.5" y="2.5" width="13" height="11" rx="1.5"/><path d="M6 2.5v11"/>',
  right: '<rect x="1.5" y="2.5" width="13" height="11" rx="1.5"/><path d="M10 2.5v11"/>',
  bottom: '<rect x="1.5" y="2.5" width="13" height="11" rx="1.5"/><path d="M1.5 9.5h13"/>',
  logo: '<circle cx="7.5" cy="8.8" r="5.7" fill="#2f81f7" stroke="none"/><circle cx="5.4" cy="6.6" r="1.7" fill="#fff" stroke="none" opacity=".85"/><circle cx="13" cy="3.2" r="2" fill="#7cc4ff" stroke="none"/>',
  model: '<path d="M8 1.5l5.5 3v7L8 14.5l-5.5-3v-7zM2.5 4.5L8 7.5l5.5-3M8 7.5v7"/>',
  link: '<rect x="3" y="3" width="10" height="10" rx="2"/>',
  joint: '<circle cx="8" cy="8" r="2.2"/><path d="M8 1.5v4M8 10.5v4"/><path d="M12.5 5.5a5.2 5.2 0 0 1 0 5"/>',
  frame: '<path d="M4 12V3M4 12h9M4 12l4-4"/>',
  sensor: '<circle cx="4" cy="8" r="1.5" fill="currentColor"/><path d="M7.5 5a4.5 4.5 0 0 1 0 6M10 3a7.5 7.5 0 0 1 0 10"/>',
  light: '<path d="M5.5 10.5a4 4 0 1 1 5 0v1.5h-5zM6.2 14.2h3.6"/>',
  box: '<path d="M8 1.5l5.5 3v7L8 14.5l-5.5-3v-7zM2.5 4.5L8 7.5l5.5-3M8 7.5v7"/>',
  sphere: '<circle cx="8" cy="8" r="6"/><path d="M2 8c2 2.4 10 2.4 12 0"/>',
  cylinder: '<ellipse cx="8" cy="3.8" rx="4.5" ry="1.8"/><path d="M3.5 3.8v8.4c0 1 2 1.8 4.5 1.8s4.5-.8 4.5-1.8V3.8"/>',
  cone: '<path d="M8 1.5L3 12.2c0 1 2.2 1.8 5 1.8s5-.8 5-1.8z"/>',
  capsule: '<rect x="4.5" y="1.5" width="7" height="13" rx="3.5"/>',
  open: '<path d="M1.5 13V3.5h4.5l1.5 2h6V7M1.5 13l2.5-6h11l-2.3 6z"/>',
  chevron: '<path d="M6 4l4 4-4 4"/>',
  script: '<path d="M4 1.5h5.5L13 5v9.5H4zM9 1.5V5h4"/>',
  move: '<path d="M8 1.5v13M1.5 8h13M8 1.5L6 3.5M8 1.5l2 2M8 14.5l-2-2M8 14.5l2-2M1.5 8l2-2M1.5 8l2 2M14.5 8l-2-2M14.5 8l-2 2"/>',
  turn: '<path d="M13 8a5 5 0 1 1-1.6-3.7M13 2v3h-3"/>',
  trash: '<path d="M2.5 4h11M6 4V2.5h4V4M4 4l.7 9.5h6.6L12 4"/>',
  copy: '<rect x="5.5" y="5.5" width="8" height="8" rx="1"/><path d="M10.5 5.5v-3h-8v8h3"/>',
  undo: '<path d="M3 6h6.5a3.5 3.5 0 0 1 0 7H6M3 6l3-3M3 6l3 3"/>',
  redo: '<path d="M13 6H6.5a3.5 3.5 0 0 0 0 7H10M13 6l-3-3M13 6l-3 3"/>',
  save: '<path d="M2.5 2.5h9l2 2v9h-11zM5 2.5v4h6v-4M5 13.5v-4h6v4"/>',
  add: '<path d="M8 2.5v11M2.5 8h11"/>',
  hand: '<path d="M8 14V8M8 8l4-4M12 4h-3M12 4v3"/><circle cx="8" cy="14" r="1"/>',
  camera: '<path d="M1.5 4.5h3l1-2h5l1 2h3v9h-13z"/><circle cx="8" cy="8.5" r="2.5"/>',
  magnet: '<path d="M3 2v6a5 5 0 0 0 10 0V2h-3v6a2 2 0 0 1-4 0V2z"/>',
  theme: '<circle cx="8" cy="8" r="5.7"/><path d="M8 2.3a5.7 5.7 0 0 1 0 11.4z" fill="currentColor"/>',
  whole: '<path d="M9.5 2.5h4v4M13.5 2.5l-4.5 4.5M6.5 13.5h-4v-4M2.5 13.5l4.5-4.5"/>',
  info: '<circle cx="8" cy="8" r="6.2"/><path d="M8 7.2v4M8 4.6v.8"/>',
};

export function icon(name) {
  const holder = document.createElement("span");
  holder.className = "icon";
  holder.innerHTML = `<svg viewBox="0 0 16 16" width="16" height="16" fill="none" stroke="currentColor" stroke-width="1.4" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${PATHS[name]}</svg>`;
  return holder;
}
