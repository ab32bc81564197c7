// SPDX-License-Identifier: MIT
// Axes and paper of all charts.
const INK = "#222222";
const FAINT = "#dddddd";

/** Logarithmic if there are values that its labels are for. */
function axis(title, logValues, more) {
  return {
    title: {text: title, standoff: 8},
    type: logValues ? "log" : "linear",
    automargin: true,
    gridcolor: FAINT,
    linecolor: INK,
    zerolinecolor: FAINT,
    ticks: "outside",
    tickcolor: INK,
    ...(logValues ? logTicks(logValues) : {}),
    ...more,
  };
}

/** A line or marks of cells in somebody's look, each mark leading to the samples of a stage. */
function scatter(name, look, cells, stage, {marker, ...more}) {
  return {
    type: "scatter",
    name,
    ...samplesOf(cells, stage),
    line: {color: look.colour, dash: look.dash, width: 1.5},
    marker: {color: look.colour, symbol: look.symbol, line: {color: INK, width: 0.4}, ...marker},
    ...more,
  };
}

/** Labels of a logarithmic axis: powers of ten, 2 and 5 of each where these are few, all digits where those are. */
function logTicks(values) {
  const there = values.filter((value) => value > 0);
  const ratio = Math.max(...there) / Math.min(...there);
  return {dtick: ratio < 8 ? "D1" : ratio < 300 ? "D2" : 1};
}

/** Whether values are so far apart that a logarithmic axis is needed, and may be had. */
function isWide(values) {
  return Math.min(...values) > 0 && Math.max(...values) / Math.min(...values) >= 8;
}

function layoutOf(more) {
  return {
    font: {family: "system-ui, sans-serif", size: 12, color: INK},
    paper_bgcolor: "#ffffff",
    plot_bgcolor: "#ffffff",
    margin: {l: 56, r: 18, t: 14, b: 48},
    showlegend: false,
    hoverlabel: {align: "left", namelength: -1},
    ...more,
  };
}
