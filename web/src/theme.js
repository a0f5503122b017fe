// SPDX-License-Identifier: BSD-3-Clause
// Whether the page is light or dark: as the system, or the other one if it was chosen, which is kept.
const KEY = "theme";
const systemPrefersDark = matchMedia("(prefers-color-scheme: dark)");

export function applyTheme() {
  document.documentElement.style.colorScheme = localStorage.getItem(KEY) ?? "";
}

export function switchTheme() {
  const system = systemPrefersDark.matches ? "dark" : "light";
  const other = (localStorage.getItem(KEY) ?? system) === "dark" ? "light" : "dark";
  if (other === system) localStorage.removeItem(KEY);
  else localStorage.setItem(KEY, other);
  applyTheme();
}
