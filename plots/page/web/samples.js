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

/** Returns the nanoseconds of a stage in a sample, by the device's clock, or else the host's. */
function nanosecondsOf(stage, place) {
  const span = at(stage.span_ns, place);
  return span !== undefined && span !== null ? span : at(stage.wall_ns, place);
}

/** Returns the facts of a cell as [name, text], with nested ones flattened. */
function factsOf(value, prefix) {
  return Object.entries(value).flatMap(([key, entry]) => {
    const name = prefix ? `${prefix} ${key}` : key;
    return entry !== null && typeof entry === "object" && !Array.isArray(entry)
      ? factsOf(entry, name)
      : [[name.replace(/_/g, " "), Array.isArray(entry) ? entry.join(" ") : String(entry)]];
  });
}

function samplesTable(samples, key, marked) {
  const isTime = key === "span_ns";
  const stages = Object.entries(samples.stages).filter(
    ([, values]) => values[key] !== undefined || (isTime && values.wall_ns !== undefined)
  );
  const own = Object.entries(samples.own);
  const ofStage = (values, place) => (isTime ? nanosecondsOf(values, place) : at(values[key], place));
  const columns = [
    ...own.map(([name, values]) => ({label: name.replace(/_/g, " "), of: (place) => at(values, place)})),
    ...(isTime ? [{label: "whole", unit: "ns", of: (place) => at(samples.whole, place)}] : []),
    ...stages.map(([label, values]) => ({label, of: (place) => ofStage(values, place)})),
  ].map((column) => ({kind: "count", ...column}));
  const isPlain = (value) => value === null || !["boolean", "object"].includes(typeof value);
  const plain = (value) => (isPlain(value) ? value ?? null : JSON.stringify(value));
  const rows = Array.from({length: samples.count}, (_, place) => columns.map((column) => plain(column.of(place))));
  const table = new SortedTable({title: "Raw samples", columns, rows, cells: null}, 0);
  const place = columns.findIndex((column) => column.label === marked);
  table.element.classList.add("raw");
  if (place >= 0) {
    table.heads[place].classList.add("marked");
  }
  return table.element;
}

async function drawSamples(plot, samples, stage, quantiles, look) {
  await libraryOf("plotly");
  const isWhole = stage === "whole" || !samples.stages[stage];
  const times = Array.from({length: samples.count}, (_, place) =>
    isWhole ? at(samples.whole, place) : nanosecondsOf(samples.stages[stage], place)
  );
  const unit = unitFor(times.filter((time) => time !== undefined && time !== null));
  const order = times.map((_, place) => (samples.own.order === undefined ? place : at(samples.own.order, place)));
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
    x: order,
    y: times.map((time) => time / unit[1]),
    name: stage,
    marker: {color: themed(look).colour, size: 6, line: {color: colour("ink"), width: 0.4}},
    hovertemplate: `sample %{x}<br>%{y:.5g} ${unit[0]}<extra></extra>`,
  };
  const layout = layoutOf({
    height: 260,
    shapes: lines,
    xaxis: axis("place in the run", null, {tickformat: "d"}),
    yaxis: axis(`${isWhole ? "whole" : stage}, ${unit[0]}`, null, {rangemode: "tozero"}),
  });
  await Plotly.react(plot, [marks], layout, {displaylogo: false, responsive: true, displayModeBar: false});
  plot.classList.add("drawn");
}

async function showSamples(file, place, stage) {
  const dialog = document.getElementById("samples");
  const data = await jsonOf("file-" + file);
  const samples = (await jsonOf("samples-" + file))[place];
  const cell = data.cells[place];
  const keys = Object.keys(QUANTITY).filter(
    (key) => key !== "wall_ns" && Object.values(samples.stages).some((columns) => columns[key] !== undefined)
  );
  const others = [...new Set(Object.values(samples.stages).flatMap((columns) => Object.keys(columns)))].filter(
    (key) => !(key in QUANTITY)
  );
  const all = [...new Set(["span_ns", ...keys, ...others])];
  const holder = element("div");
  const tableOf = (key) => (samples.count ? samplesTable(samples, key, stage) : element("p", {}, "No sample was taken."));
  const fill = (key) => holder.replaceChildren(tableOf(key));
  const select = menu(all.map((key) => [key, QUANTITY[key] || key.replace(/_/g, " ")]), fill);
  const plot = element("div", {class: "drawing", role: "img", "aria-label": "Samples in the order of the run"});
  const quantiles = cell.times[stage];
  const [low, middle, high] = (quantiles || []).map((ns) => `${four(ns / 1e3)}`);
  const said = quantiles
    ? `Median ${middle} µs, 10th to 90th percentile ${low} to ${high} µs, ${plural(samples.count, "sample")}.`
    : cell.why || "";
  const frame = cell.frame ? `, frame ${cell.frame}` : "";
  const title = `${cell.who} on ${cell.scene}${frame}${stage === "whole" ? "" : `: ${stage}`}`;
  const facts = factsOf(samples.facts, "").map(([name, text]) =>
    element("div", {}, element("dt", {}, name), element("dd", {}, text))
  );
  const close = element("button", {type: "button", click: () => dialog.close()}, "Close");
  dialog.replaceChildren(
    element("div", {class: "dialog-head"}, element("h2", {id: "samples-title"}, title), close),
    element("p", {}, badge(cell.state), " ", said),
    ...(samples.count && quantiles
      ? [plot, element("p", {class: "note"}, "Lines: median, and dotted 10th and 90th percentile.")]
      : []),
    element("h3", {}, "Raw samples"),
    ...(samples.count && all.length > 1 ? [element("label", {}, "Of each stage ", select)] : []),
    holder,
    element("h3", {}, "The cell"),
    element("dl", {class: "facts"}, ...facts)
  );
  fill("span_ns");
  if (!dialog.open) {
    dialog.showModal();
  }
  dialog.scrollTop = 0;
  if (samples.count && quantiles) {
    plot.chart = {draw: () => drawSamples(plot, samples, stage, quantiles, data.looks[cell.who])};
    await plot.chart.draw();
  }
}
