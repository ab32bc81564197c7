// SPDX-License-Identifier: MIT
// Axes and background of all charts.
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
    ...(logValues ? logTicks(logValues) : {}),
    ...more,
  };
}

/** Returns a line or marks of cells in the given look. Each mark links to the samples of a stage. */
function scatter(name, plain, cells, stage, {marker, ...more}) {
  const look = themed(plain);
  return {
    type: "scatter",
    name,
    ...samplesOf(cells, stage),
    line: {color: look.colour, dash: look.dash, width: 1.5},
    marker: {color: look.colour, symbol: look.symbol, line: {color: colour("ink"), width: 0.4}, ...marker},
    ...more,
  };
}

/** Labels of a logarithmic axis: powers of ten; with few of those 2 and 5 of each too; with very few all digits. */
function logTicks(values) {
  const there = values.filter((value) => value > 0);
  const ratio = Math.max(...there) / Math.min(...there);
  return {dtick: ratio < 8 ? "D1" : ratio < 300 ? "D2" : 1};
}

/** True if values differ so much that a logarithmic axis is needed, and all are positive. */
function isWide(values) {
  return Math.min(...values) > 0 && Math.max(...values) / Math.min(...values) >= 8;
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
