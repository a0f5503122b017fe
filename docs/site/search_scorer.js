// SPDX-License-Identifier: BSD-3-Clause
// Headings that contain the whole query come first. So it was until Sphinx 7; since then, a page with the words in
// several headings has more points. The other numbers are Sphinx's own.
var Scorer = {
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
  // page, title, anchor, description, points, file, kind (since Sphinx 8.1)
  score: ([, , , , points, , kind]) => (kind === "title" ? (points * 100) / 15 : points),
};
