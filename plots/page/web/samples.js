// SPDX-License-Identifier: MIT
// The raw samples behind a number: a dialog with the facts of the cell, every sample, and a plot over the run.
const QUANTITY = {
  span_ns: "first start to last end, ns (device clock)",
  wall_ns: "ns on the host's clock",
  start_ns: "start in the sample, ns",
  busy_ns: "sum over launches, ns",
  launches: "launches",
  moved_bytes: "bytes that must move",
};

function at(column, place) {
  return Array.isArray(column) ? column[place] : column;
}

/** Returns a quantity of a stage in a sample. Its span is by the device's clock, or else the host's. */
function quantityOf(stage, key, place) {
  const own = at(stage[key], place);
  return key === "span_ns" ? own ?? at(stage.wall_ns, place) : own;
}

function worded(key) {
  return key.replace(/_/g, " ");
}

/** Returns the facts of a cell or a run as rows of a list, with nested ones flattened. */
function factsOf(value, prefix) {
  return Object.entries(value).flatMap(([key, entry]) => {
    const name = prefix + worded(key);
    const isNested = entry !== null && typeof entry === "object" && !(Array.isArray(entry) && typeof entry[0] !== "object");
    const row = () => element("div", {}, element("dt", {}, name), element("dd", {}, [entry].flat().map(String).join(" ")));
    return isNested ? factsOf(entry, name + " ") : [row()];
  });
}

function samplesTable(samples, key, marked) {
  const stages = Object.entries(samples.stages).filter(([, stage]) => key in stage || (key === "span_ns" && "wall_ns" in stage));
  const own = Object.entries(samples.own).map(([name, values]) => ({label: worded(name), of: (place) => at(values, place)}));
  const whole = {label: "whole", unit: "ns", of: (place) => at(samples.whole, place)};
  const each = stages.map(([label, stage]) => ({label, of: (place) => quantityOf(stage, key, place)}));
  const columns = [...own, ...(key === "span_ns" ? [whole] : []), ...each].map((column) => ({kind: "count", ...column}));
  const plain = (value) => (["boolean", "object"].includes(typeof (value ?? 0)) ? JSON.stringify(value) : value ?? null);
  const rows = Array.from({length: samples.count}, (_, place) => columns.map((column) => plain(column.of(place))));
  const table = new SortedTable({title: "Raw samples", columns, rows}, 0);
  table.element.classList.add("raw");
  table.heads.find((_, k) => columns[k].label === marked)?.classList.add("marked");
  return table.element;
}

async function drawSamples(plot, samples, stage, quantiles, look) {
  await libraryOf("plotly");
  const isWhole = !samples.stages[stage];
  const timeAt = (place) => (isWhole ? at(samples.whole, place) : quantityOf(samples.stages[stage], "span_ns", place));
  const places = [...Array(samples.count).keys()];
  const times = places.map(timeAt);
  const unit = unitFor(times.filter((time) => (time ?? null) !== null));
  const lines = quantiles.map((value, k) => ({
    type: "line",
    xref: "paper",
    x0: 0,
    x1: 1,
    y0: value / unit[1],
    y1: value / unit[1],
    line: {color: colour("quiet"), width: 1, dash: k === 1 ? "solid" : "dot"},
  }));
  const marks = {
    type: "scatter",
    mode: "markers",
    x: places.map((place) => at(samples.own.order, place) ?? place),
    y: times.map((time) => time / unit[1]),
    name: stage,
    marker: {color: themed(look).colour, size: 6, line: {color: colour("ink"), width: 0.4}},
    hovertemplate: `sample %{x}<br>%{y:.5g} ${unit[0]}<extra></extra>`,
  };
  const layout = {
    height: 260,
    shapes: lines,
    xaxis: axis("place in the run", null, {tickformat: "d"}),
    yaxis: axis(`${isWhole ? "whole" : stage}, ${unit[0]}`, null, {rangemode: "tozero"}),
  };
  await drawPlot(plot, [marks], layout, false);
}

async function showSamples(file, place, stage) {
  const dialog = document.getElementById("samples");
  const data = await jsonOf("file-" + file);
  const samples = (await jsonOf("samples-" + file))[place];
  const cell = data.cells[place];
  const there = new Set(["span_ns", ...Object.values(samples.stages).flatMap((columns) => Object.keys(columns))]);
  there.delete("wall_ns"); // it stands in the place of a span
  const keys = [...new Set([...Object.keys(QUANTITY).filter((key) => there.has(key)), ...there])];
  const holder = element("div", {});
  const tableOf = (key) => (samples.count ? samplesTable(samples, key, stage) : element("p", {}, "No sample was taken."));
  const fill = (key) => holder.replaceChildren(tableOf(key));
  const select = menu(keys.map((key) => [key, QUANTITY[key] || worded(key)]), fill);
  const plot = element("div", {class: "drawing", role: "img", "aria-label": "Samples in the order of the run"});
  const quantiles = cell.times[stage];
  const [low, middle, high] = (quantiles || []).map((ns) => four(ns / 1e3));
  const said = quantiles
    ? `Median ${middle} µs, 10th to 90th percentile ${low} to ${high} µs, ${plural(samples.count, "sample")}.`
    : cell.why;
  const frame = cell.frame ? `, frame ${cell.frame}` : "";
  const title = `${cell.who} on ${cell.scene}${frame}${stage === "whole" ? "" : `: ${stage}`}`;
  const close = button({click: () => dialog.close()}, "Close");
  const isDrawn = samples.count && quantiles;
  dialog.replaceChildren(
    element("div", {class: "dialog-head"}, element("h2", {id: "samples-title"}, title), close),
    element("p", {}, badge(cell.state), " ", said),
    ...(isDrawn ? [plot, element("p", {class: "note"}, "Lines: median, and dotted 10th and 90th percentile.")] : []),
    element("h3", {}, "Raw samples"),
    ...(samples.count && keys.length > 1 ? [element("label", {}, "Of each stage ", select)] : []),
    holder,
    element("h3", {}, "The cell"),
    element("dl", {class: "facts"}, ...factsOf(samples.facts, ""))
  );
  fill("span_ns");
  if (!dialog.open) {
    dialog.showModal();
  }
  dialog.scrollTop = 0;
  if (isDrawn) {
    plot.chart = {draw: () => drawSamples(plot, samples, stage, quantiles, data.looks[cell.who])};
    await plot.chart.draw();
  }
}
