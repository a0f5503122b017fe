// SPDX-License-Identifier: BSD-3-Clause
// Debian 12's furo has its dark colours only for a reader who has chosen them, and code is dark for all whose system is.
document.addEventListener("DOMContentLoaded", () => {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  if (document.body.dataset.theme === "auto" && isDark) document.body.dataset.theme = "dark";
});
