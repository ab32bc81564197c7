// SPDX-License-Identifier: MIT
// Time for each frame: one line for each pipeline, over the frames of a scene.
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
    {
      Scene: useful.map(([name]) => name),
      Show: [
        ...stages.map((stage) => [stage, stage === "whole" ? "whole frame" : stage]),
        ...counted.map((key) => [key, COUNTED[key]]),
      ],
      Scale: [["linear", "linear, from 0"], ["log", "logarithmic"]],
    },
    (scene, show, scale) => {
      const here = scenes.get(scene);
      const isTime = !(show in COUNTED);
      const timed = here.filter((cell) => cell.times[isTime ? show : "whole"]);
      const unit = isTime ? unitFor(timed.map((cell) => cell.times[show][1])) : ["", 1];
      const value = (cell) => (isTime ? cell.times[show][1] / unit[1] : cell.counters[show]);
      const traces = [...grouped(here, (cell) => cell.who)]
        .map(([name, group]) => {
          const points = group.sort((a, b) => a.frame - b.frame);
          return scatter(name, file.looks[name], points, isTime ? show : "whole", {
            mode: points.length > 60 ? "lines" : "lines+markers",
            connectgaps: false,
            x: points.map((cell) => cell.frame),
            y: points.map((cell) => (timed.includes(cell) ? value(cell) : null)),
            marker: {size: 6},
            hovertemplate: `frame %{x}<br>%{y:,.4g} ${unit[0]}<extra>%{fullData.name}</extra>`,
          });
        })
        .filter((trace) => trace.y.some((y) => y !== null));
      const last = Math.max(...here.map((cell) => cell.frame));
      const isLog = scale === "log" && traces.every((trace) => trace.y.every((y) => y === null || y > 0));
      return {
        traces,
        legend: legendOf(here, file.looks),
        layout: {
          height: 430,
          xaxis: axis("frame", null, {tickformat: "d", dtick: Math.max(1, Math.ceil(last / 12))}),
          yaxis: axis(
            isTime ? `${show === "whole" ? "whole frame" : show}, ${unit[0]}` : COUNTED[show],
            isLog ? traces.flatMap((trace) => trace.y) : null,
            {tickformat: ",.4~r", rangemode: "tozero"}
          ),
        },
        notes: [isTime ? "Medians of each frame." : "", ...missingNotes(here), ...starNotes(file, here)],
      };
    }
  );
}
