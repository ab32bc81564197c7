// SPDX-License-Identifier: MIT
// Time against size: one line for each builder along the sizes of a generator, and points where each size is another mesh.
const QUANTITIES = {
  time: {text: "time", axis: (unit) => `time, ${unit[0]}`, of: (ns, triangles, unit) => ns / unit[1]},
  each: {text: "time a triangle", axis: () => "time a triangle, ns", of: (ns, triangles) => ns / triangles},
  rate: {text: "triangles a second", axis: () => "million triangles a second", of: (ns, triangles) => (1e3 * triangles) / ns},
};

const DASHES_OF_FAMILIES = ["solid", "dot", "dash", "dashdot"];
const MOST_NAMES = 12; // of scenes, along the axis
const MOST_SCENES = 40; // in the menu

/** Returns a function that names a cell's family: generated scenes of several sizes, drawn as a line. Empty for others. */
function familiesOf(cells) {
  const sizes = Map.groupBy(cells, (cell) => cell.family);
  const isLine = (family) => family && distinct(sizes.get(family), "triangles").length > 1;
  const lines = new Set([...sizes.keys()].filter(isLine));
  return (cell) => (lines.has(cell.family) ? cell.family : "");
}

/** Returns how each family looks if there are several: by dash, the first with filled marks. */
function familyLooks(cells, familyOf) {
  const families = [...new Set(cells.map(familyOf))].filter(Boolean);
  const look = (k) => ({line: true, dash: DASHES_OF_FAMILIES[k % DASHES_OF_FAMILIES.length], isOpen: k > 0});
  return families.length > 1 ? new Map(families.map((family, k) => [family, look(k)])) : new Map();
}

function sizeTraces(cells, familyOf, stage, quantity, unit, looks) {
  const families = familyLooks(cells, familyOf);
  const lines = Map.groupBy(cells, (cell) => [cell.who, familyOf(cell), cell.asked].join("\n"));
  return [...lines.values()].map((line) => {
    const {who, asked} = line[0];
    const family = familyOf(line[0]);
    const ofFamily = families.get(family);
    const plain = looks[who];
    const look = ofFamily ? {...plain, dash: ofFamily.dash, symbol: plain.symbol + (ofFamily.isOpen ? "-open" : "")} : plain;
    const points = line.sort((a, b) => a.triangles - b.triangles);
    const value = (cell, place) => quantity.of(cell.times[stage][place], cell.triangles, unit);
    const middle = points.map((cell) => value(cell, 1));
    const ends = points.map((cell) => [value(cell, 0), value(cell, 2)].sort((a, b) => a - b));
    return scatter(who, look, points, stage, {
      meta: family,
      mode: family && points.length > 1 ? "lines+markers" : "markers",
      x: points.map((cell) => cell.triangles),
      y: middle,
      text: points.map((cell) => cell.scene),
      marker: {size: points.length > 40 ? 4 : 7, ...(ofFamily && ofFamily.isOpen ? {line: {width: 1.2}} : {})},
      error_y: {
        type: "data",
        symmetric: false,
        thickness: 1,
        width: 2,
        color: themed(look).colour,
        visible: points.length <= 40,
        array: ends.map((end, k) => end[1] - middle[k]),
        arrayminus: ends.map((end, k) => middle[k] - end[0]),
      },
      hovertemplate: `%{text}, %{x:,} triangles<br>%{y:.4g}${asked && "<br>" + asked}<extra>%{fullData.name}</extra>`,
    });
  });
}

/**
 * Names stand-ins and scenes of one size along the axis, in the half of the chart where they have no marks. Those of nearly one
 * size share a line.
 */
function meshNames(traces) {
  const all = traces.flatMap(({x, y, text, meta}) => x.map((size, k) => ({size, scene: text[k], y: y[k], family: meta})));
  const marks = all.filter(({scene, family}) => !family || scene.includes(" *"));
  const scenes = [...Map.groupBy(marks, (mark) => mark.scene).values()].sort((a, b) => a[0].size - b[0].size);
  if (!scenes.length || scenes.length > MOST_NAMES) {
    return [];
  }
  const heights = all.map((mark) => Math.log(mark.y));
  const middle = (Math.max(...heights) + Math.min(...heights)) / 2;
  const sizes = all.map((mark) => Math.log10(mark.size));
  const near = (narrow.matches ? 0.08 : 0.03) * (Math.max(...sizes) - Math.min(...sizes));
  const labels = [];
  for (const group of scenes) {
    const x = Math.log10(group[0].size);
    const last = labels[labels.length - 1];
    const isLow = group.reduce((sum, mark) => sum + Math.log(mark.y), 0) / group.length < middle;
    if (last && x - last.x < near) {
      last.scenes.push(group[0].scene);
    } else {
      labels.push({x, scenes: [group[0].scene], y: isLow ? 1 : 0, yanchor: isLow ? "top" : "bottom"});
    }
  }
  const font = {size: 11, color: colour("quiet")};
  const text = (names) => (names.length > 2 ? `${names[0]} and ${names.length - 1} more` : names.join(", "));
  const how = {yref: "paper", textangle: -90, xshift: -12, showarrow: false, font};
  return labels.map(({scenes: names, ...label}) => ({...label, text: text(names), ...how}));
}

function sizeChart(file) {
  const builds = file.cells.filter((cell) => ["build", "refit"].includes(cell.operation) && cell.triangles);
  const sizes = Map.groupBy(builds, (cell) => cell.experiment);
  const {names, cells: all, stages} = groupsThatVary(sizes, "triangles", 2);
  if (!names.length) {
    return null;
  }
  const familyOf = familiesOf(builds);
  const placeOf = (cell) => familyOf(cell) || cell.scene;
  const places = [...new Set(all.map(placeOf))];
  const wanted = stages.length === 2 ? ["whole"] : stages; // a single stage is the whole
  const choices = {
    Experiment: names,
    Stage: wanted.map((stage) => [stage, stage === "whole" ? "whole build" : stage]),
    Scenes: places.length === 1 ? [["", places[0]]] : [["", "all"], ...(places.length <= MOST_SCENES ? places : [])],
    Show: Object.entries(QUANTITIES).map(([key, quantity]) => [key, quantity.text]),
  };
  return new Chart("Time against size", file, choices, (experiment, stage, scene, key) => {
    const here = sizes.get(experiment).filter((cell) => !scene || placeOf(cell) === scene);
    const cells = here.filter((cell) => cell.times[stage] && cell.times[stage][0] > 0);
    const unit = unitFor(cells.map((cell) => cell.times[stage][1]));
    const quantity = QUANTITIES[key];
    const traces = sizeTraces(cells, familyOf, stage, quantity, unit, file.looks);
    const hasPoints = cells.some((cell) => !familyOf(cell));
    const shapes = hasPoints ? " Points without a line are scenes of one size, each another shape." : "";
    const ofFamily = (family, look) => ({name: family, look, isOf: (trace) => trace.meta === family});
    const families = [...familyLooks(cells, familyOf)].map(([family, look]) => ofFamily(family, look));
    return {
      traces,
      cells: here,
      asked: here,
      legend: [...legendOf(cells, file.looks), ...families],
      layout: {
        height: 430,
        annotations: meshNames(traces),
        xaxis: axis("triangles", cells.map((cell) => cell.triangles), {tickformat: "~s"}),
        yaxis: axis(quantity.axis(unit), traces.flatMap((trace) => trace.y), {tickformat: ",.4~r"}),
      },
      notes: ["Medians; bars from the 10th to the 90th percentile." + shapes],
    };
  });
}
