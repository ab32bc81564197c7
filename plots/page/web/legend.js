// SPDX-License-Identifier: MIT
// Entries of a chart's legend: a name, and a shape in its colour, as Plotly draws it.
const SHAPES = {
  // SVG paths around 0 for Plotly's symbols
  circle: "M4,0A4,4 0 1 1 -4,0A4,4 0 1 1 4,0Z",
  square: "M-3.6,-3.6H3.6V3.6H-3.6Z",
  diamond: "M0,-5L5,0L0,5L-5,0Z",
  "diamond-tall": "M0,-6L3,0L0,6L-3,0Z",
  "triangle-up": "M0,-4.6L4.6,3.6H-4.6Z",
  "triangle-down": "M0,4.6L4.6,-3.6H-4.6Z",
  "triangle-left": "M-4.6,0L3.6,-4.6V4.6Z",
  "triangle-right": "M4.6,0L-3.6,-4.6V4.6Z",
  pentagon: "M0,-5L4.8,-1.5L2.9,4H-2.9L-4.8,-1.5Z",
  hexagon: "M0,-5L4.3,-2.5V2.5L0,5L-4.3,2.5V-2.5Z",
  hexagon2: "M-5,0L-2.5,-4.3H2.5L5,0L2.5,4.3H-2.5Z",
  star: "M0,-5.5L1.4,-1.7H5.3L2.2,0.7L3.3,4.6L0,2.3L-3.3,4.6L-2.2,0.7L-5.3,-1.7H-1.4Z",
  cross: "M-1.6,-4.6H1.6V-1.6H4.6V1.6H1.6V4.6H-1.6V1.6H-4.6V-1.6H-1.6Z",
  x: "M-4.4,-2.2L-2.2,-4.4L0,-2.2L2.2,-4.4L4.4,-2.2L2.2,0L4.4,2.2L2.2,4.4L0,2.2L-2.2,4.4L-4.4,2.2L-2.2,0Z",
};

const DASHES = {solid: "none", dash: "6 4", dot: "2 3", dashdot: "6 3 2 3"};

const HATCHES = {
  "/": "M-3,3L3,-3",
  x: "M-3,3L3,-3M-3,-3L3,3",
  "+": "M-3.6,0H3.6M0,-3.6V3.6",
  ".": "M-2.4,-1.6h1.6M0.8,-1.6h1.6M-2.4,1.6h1.6M0.8,1.6h1.6",
};

/** Draws a look for a legend: a shape, with a stroke if it is hatched, or a dashed line with a mark, filled or open. */
function swatch(plain) {
  const {colour: fill, symbol, pattern, line, dash, isOpen} = themed(plain);
  const hatch = pattern ? `<path d="${HATCHES[pattern]}" stroke="#ffffff" stroke-width="1.6" fill="none"/>` : "";
  const shape = `<path d="${SHAPES[symbol]}" fill="${fill}" stroke="currentColor" stroke-width="0.6"/>${hatch}`;
  const mark = `<circle r="3" fill="${isOpen ? "var(--card)" : "currentColor"}"/>`;
  const dashed = `<g stroke="currentColor" stroke-width="1.4"><path d="M-14,0H14" stroke-dasharray="${DASHES[dash]}"/>${mark}</g>`;
  const box = line ? 'viewBox="-14 -7 28 14" class="wide"' : 'viewBox="-8 -7 16 14"';
  const made = element("template", {});
  made.innerHTML = `<svg ${box} aria-hidden="true">${line ? dashed : shape}</svg>`;
  return made.content.firstChild;
}

/** Returns the legend entries of these cells, in the order of the file's looks. */
function legendOf(cells, looks) {
  const there = new Set(cells.map((cell) => cell.who));
  const names = Object.keys(looks).filter((name) => there.has(name));
  return names.map((name) => ({name, look: looks[name]}));
}
