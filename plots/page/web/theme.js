// SPDX-License-Identifier: MIT
// Colours of charts and scenes, those of the page, light or dark; axes and background of all charts.
const dark = matchMedia("(prefers-color-scheme: dark)");
const inTheDark = {}; // colours of figures that are too dark on a dark page, and their replacements; from plot_looks.py

/** Returns a colour of base.css, such as colour("ink"). */
function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

/** Returns a look with a colour that can be seen on the page. */
function themed(look) {
  return {...look, colour: (dark.matches && inTheDark[look.colour]) || look.colour};
}

/** Returns an axis, logarithmic if `logValues` holds the values for its labels. */
function axis(title, logValues, more) {
  return {
    title: {text: title, standoff: 8},
    type: logValues ? "log" : "linear",
    automargin: true,
    gridcolor: colour("line"),
    linecolor: colour("ink"),
    zerolinecolor: colour("line"),
    ticks: "outside",
    tickcolor: colour("ink"),
    ...(logValues ? {dtick: logStep(logValues)} : {}),
    ...more,
  };
}

/** Labels of a logarithmic axis: powers of ten; with few of those 2 and 5 of each too; with very few all digits. */
function logStep(values) {
  const ratio = spanOf(values.filter((value) => value > 0));
  return ratio < 8 ? "D1" : ratio < 300 ? "D2" : 1;
}

function spanOf(values) {
  return Math.max(...values) / Math.min(...values);
}

/** True if values differ so much that a logarithmic axis is needed, and all are positive. */
function isWide(values) {
  return Math.min(...values) > 0 && spanOf(values) >= 8;
}

function layoutOf(more) {
  return {
    font: {family: "system-ui, sans-serif", size: 12, color: colour("ink")},
    paper_bgcolor: colour("card"),
    plot_bgcolor: colour("card"),
    modebar: {bgcolor: "rgba(0,0,0,0)", color: colour("line"), activecolor: colour("quiet")},
    margin: {l: 56, r: 18, t: 14, b: 48},
    showlegend: false,
    hoverlabel: {align: "left", namelength: -1},
    ...more,
  };
}
