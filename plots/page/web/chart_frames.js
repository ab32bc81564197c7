// SPDX-License-Identifier: MIT
// Time for each frame, or at each commit of a history: one line for each builder or pipeline of a scene.
/** Returns the band of a line from the 10th to the 90th percentile, in a part for each stretch without a gap. */
function bandsOf(name, fillcolor, cells, value) {
  return [...Map.groupBy(cells, (cell, k) => cell.frame - k).values()].map((there) => {
    const back = there.toReversed();
    const y = [...there.map((cell) => value(cell, 2)), ...back.map((cell) => value(cell, 0))];
    const x = [...there, ...back].map((cell) => cell.frame);
    return {type: "scatter", name, mode: "none", fill: "toself", fillcolor, hoverinfo: "skip", x, y};
  });
}

/** Returns a mark for each change of a line. Where there is no time, it is as high as the last one. */
function changesOf(name, cells, value) {
  let last = 0;
  const heights = new Map(cells.map((cell) => [cell, (last = value(cell) ?? last)]));
  const told = cells.filter((cell) => cell.told.length);
  const symbol = told.map((cell) => (value(cell) === null ? "x-open" : "circle-open"));
  const marker = {size: 13, symbol, color: colour("bad"), line: {width: 2}};
  const [x, y, text] = [(cell) => cell.frame, (cell) => heights.get(cell), (cell) => cell.told.join("<br>")].map((of) => told.map(of));
  return {type: "scatter", name, mode: "markers", x, y, text, marker, hovertemplate: "%{text}<extra>%{fullData.name}</extra>"};
}

function framesChart(file) {
  const {runs} = file; // of a history; then a cell's frame is the place of its commit
  const frames = file.cells.filter((cell) => runs || cell.operation === "collide");
  const scenes = Map.groupBy(frames, questionOf(frames));
  const {names, cells, stages} = groupsThatVary(scenes, "frame", runs ? 0 : 1);
  if (!names.length) {
    return null;
  }
  const counters = [...new Set(cells.flatMap((cell) => Object.keys(cell.counters)))];
  const stageName = (stage) => (stage === "whole" ? (runs ? "whole" : "whole frame") : stage);
  const choices = {
    Scene: names,
    Show: [...stages.map((stage) => [stage, stageName(stage)]), ...counters.map((key) => [key, worded(key)])],
    Scale: [["linear", "linear, from 0"], ["log", "logarithmic"]],
  };
  return new Chart(runs ? "Over commits" : "Time a frame", file, choices, (scene, show, scale) => {
    const here = scenes.get(scene);
    const isTime = stages.includes(show);
    const stage = isTime ? show : "whole";
    const timed = here.filter((cell) => cell.times[stage]);
    const unit = isTime ? unitFor(timed.map((cell) => cell.times[stage][1])) : ["", 1];
    const value = (cell, k = 1) => (!cell.times[stage] ? null : isTime ? cell.times[show][k] / unit[1] : cell.counters[show] ?? null);
    const traces = [...Map.groupBy(here, (cell) => cell.line ?? cell.who).values()]
      .flatMap((group) => {
        const points = group.sort((a, b) => a.frame - b.frame);
        const name = points[0].who;
        const line = scatter(name, file.looks[name], points, stage, {
          mode: points.length > 60 ? "lines" : "lines+markers",
          connectgaps: false,
          x: points.map((cell) => cell.frame),
          y: points.map((cell) => value(cell)),
          marker: {size: 6},
          hovertemplate: `${runs ? "" : "frame "}%{x}<br>%{y:,.4g} ${unit[0]}<extra>%{fullData.name}</extra>`,
          ...(runs ? {leads: null} : {}),
        });
        const timed = points.filter((cell) => isTime && value(cell) !== null);
        return runs ? [...bandsOf(name, line.line.color + "30", timed, value), line, changesOf(name, points, value)] : [line];
      })
      .filter((trace) => trace.y.some((y) => y !== null));
    const last = Math.max(...here.map((cell) => cell.frame));
    const drawn = traces.flatMap((trace) => trace.y);
    const isLog = scale === "log" && drawn.every((y) => y === null || y > 0);
    const title = isTime ? `${stageName(show)}, ${unit[0]}` : worded(show);
    const step = Math.ceil((last + 1) / (narrow.matches ? 3 : 9));
    const named = runs ? [...runs.keys()].filter((k) => k % step === 0) : [];
    const ofCommits = {tickvals: named, ticktext: named.map((k) => `${runs[k].commit}<br>${runs[k].date.slice(0, 10)}`)};
    return {
      traces,
      cells: here,
      asked: here,
      layout: {
        height: 430,
        xaxis: runs ? axis("", null, ofCommits) : axis("frame", null, {tickformat: "d", dtick: Math.max(1, Math.ceil(last / 12))}),
        yaxis: axis(title, isLog ? drawn : null, {tickformat: ",.4~r", rangemode: "tozero"}),
      },
      notes: [runs ? "Medians; bands from the 10th to the 90th percentile. Rings are changes." : isTime ? "Medians of each frame." : ""],
    };
  });
}
