// SPDX-License-Identifier: MIT
// Time a frame: a line a pipeline, over the frames of a scene.
const COUNTED = {pairs_count: "pairs found", contacts_count: "contacts found", box_tests_count: "box tests"};

function framesChart(file) {
  const frames = file.cells.filter((cell) => cell.operation === "collide");
  const scenes = grouped(frames, questionOf(frames));
  const useful = [...scenes].filter(
    ([, cells]) => new Set(cells.filter((cell) => cell.times.whole).map((cell) => cell.frame)).size > 1
  );
  if (!useful.length) {
    return null;
  }
  const cells = useful.flatMap(([, group]) => group);
  const stages = [...new Set(cells.flatMap((cell) => Object.keys(cell.times)))];
  const counted = Object.keys(COUNTED).filter((key) => cells.some((cell) => cell.counters[key] !== undefined));
  return new Chart(
    "Time a frame",
    [
      {label: "Scene", options: useful.map(([name]) => [name, name])},
      {
        label: "Show",
        options: [
          ...stages.map((stage) => [stage, stage === "whole" ? "whole frame" : stage]),
          ...counted.map((key) => [key, COUNTED[key]]),
        ],
      },
      {
        label: "Scale",
        options: [
          ["linear", "linear, from 0"],
          ["log", "logarithmic"],
        ],
      },
    ],
    (scene, show, scale) => {
      const here = scenes.get(scene);
      const isTime = !(show in COUNTED);
      const unit = isTime
        ? unitFor(here.filter((cell) => cell.times[show]).map((cell) => cell.times[show][1]))
        : ["", 1];
      const value = (cell, place) =>
        isTime
          ? cell.times[show]
            ? cell.times[show][place] / unit[1]
            : null
          : cell.times.whole
          ? cell.counters[show]
          : null;
      const traces = [...grouped(here, (cell) => cell.who)]
        .map(([name, group]) => {
          const look = file.looks[name];
          const points = group.sort((a, b) => a.frame - b.frame);
          return {
            type: "scatter",
            mode: points.length > 60 ? "lines" : "lines+markers",
            name,
            ...samplesOf(points, isTime ? show : "whole"),
            connectgaps: false,
            x: points.map((cell) => cell.frame),
            y: points.map((cell) => value(cell, 1)),
            line: {color: look.colour, dash: look.dash, width: 1.5},
            marker: {color: look.colour, symbol: look.symbol, size: 6, line: {color: INK, width: 0.4}},
            hovertemplate: `frame %{x}<br>%{y:,.4g} ${unit[0]}<extra>%{fullData.name}</extra>`,
          };
        })
        .filter((trace) => trace.y.some((y) => y !== null));
      const last = Math.max(...here.map((cell) => cell.frame));
      const isLog = scale === "log" && traces.every((trace) => trace.y.every((y) => y === null || y > 0));
      return {
        traces,
        legend: legendOf(here, file.looks),
        layout: {
          height: 430,
          xaxis: axis("frame", false, {tickformat: "d", dtick: Math.max(1, Math.ceil(last / 12))}),
          yaxis: axis(isTime ? `${show === "whole" ? "whole frame" : show}, ${unit[0]}` : COUNTED[show], isLog, {
            tickformat: ",.4~r",
            rangemode: "tozero",
            ...(isLog ? logTicks(traces.flatMap((trace) => trace.y)) : {}),
          }),
        },
        notes: [isTime ? "Medians of each frame." : "", ...missingNotes(here)],
      };
    }
  );
}
