// SPDX-License-Identifier: MIT
// Time against size: one line for each builder along the sizes of a generator, and points where each size is another mesh.
const QUANTITIES = {
  time: {text: "time", axis: (unit) => `time, ${unit[0]}`, of: (ns, triangles, unit) => ns / unit[1]},
  each: {text: "time a triangle", axis: () => "time a triangle, ns", of: (ns, triangles) => ns / triangles},
  rate: {
    text: "triangles a second",
    axis: () => "million triangles a second",
    of: (ns, triangles) => (1e3 * triangles) / ns,
  },
};

/** Returns "torus" for "torus:1000", and "" for a mesh. */
function familyOf(scene) {
  const found = /^(.*):\d+$/.exec(scene);
  return found ? found[1] : "";
}

function sizeTraces(cells, stage, quantity, unit, looks) {
  const lines = grouped(cells, (cell) => `${cell.who}\n${familyOf(cell.scene)}`);
  return [...lines.values()].map((line) => {
    const look = looks[line[0].who];
    const points = line.sort((a, b) => a.triangles - b.triangles);
    const value = (cell, place) => quantity.of(cell.times[stage][place], cell.triangles, unit);
    const middle = points.map((cell) => value(cell, 1));
    const ends = points.map((cell) => [value(cell, 0), value(cell, 2)].sort((a, b) => a - b));
    const isLine = familyOf(line[0].scene) !== "" && points.length > 1;
    return scatter(line[0].who, look, points, stage, {
      mode: isLine ? "lines+markers" : "markers",
      x: points.map((cell) => cell.triangles),
      y: middle,
      text: points.map((cell) => cell.scene),
      marker: {size: points.length > 40 ? 4 : 7},
      error_y: {
        type: "data",
        symmetric: false,
        thickness: 1,
        width: 2,
        color: look.colour,
        visible: points.length <= 40,
        array: ends.map((end, k) => end[1] - middle[k]),
        arrayminus: ends.map((end, k) => middle[k] - end[0]),
      },
      hovertemplate: "%{text}, %{x:,} triangles<br>%{y:.4g}<extra>%{fullData.name}</extra>",
    });
  });
}

function sizeChart(file) {
  const builds = file.cells.filter((cell) => ["build", "refit"].includes(cell.operation) && cell.triangles);
  const sizes = grouped(builds, (cell) => cell.experiment);
  const experiments = [...sizes].filter(
    ([, cells]) => new Set(cells.filter((cell) => cell.times.whole).map((cell) => cell.triangles)).size > 2
  );
  if (!experiments.length) {
    return null;
  }
  const stages = [...new Set(experiments.flatMap(([, cells]) => cells.flatMap((cell) => Object.keys(cell.times))))];
  const wanted = stages.length === 2 ? ["whole"] : stages; // a single stage is the whole
  return new Chart(
    "Time against size",
    {
      Experiment: experiments.map(([name]) => name),
      Stage: wanted.map((stage) => [stage, stage === "whole" ? "whole build" : stage]),
      Show: Object.entries(QUANTITIES).map(([key, quantity]) => [key, quantity.text]),
    },
    (experiment, stage, key) => {
      const all = sizes.get(experiment);
      const cells = all.filter((cell) => cell.times[stage] && cell.times[stage][0] > 0);
      const unit = unitFor(cells.map((cell) => cell.times[stage][1]));
      const quantity = QUANTITIES[key];
      const traces = sizeTraces(cells, stage, quantity, unit, file.looks);
      const meshes = cells.some((cell) => familyOf(cell.scene) === "");
      return {
        traces,
        legend: legendOf(cells, file.looks),
        layout: {
          height: 430,
          xaxis: axis("triangles", cells.map((cell) => cell.triangles), {tickformat: "~s"}),
          yaxis: axis(quantity.axis(unit), traces.flatMap((trace) => trace.y), {tickformat: ",.4~r"}),
        },
        notes: [
          "Medians; bars from the 10th to the 90th percentile." +
            (meshes ? " Points without a line are meshes, each another shape." : ""),
          ...missingNotes(all),
        ],
      };
    }
  );
}
