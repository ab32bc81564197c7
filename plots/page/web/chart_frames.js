// SPDX-License-Identifier: MIT
// Time for each frame: one line for each pipeline, over the frames of a scene.
const COUNTED = {pairs_count: "pairs found", contacts_count: "contacts found", box_tests_count: "box tests"};

function framesChart(file) {
  const frames = file.cells.filter((cell) => cell.operation === "collide");
  const scenes = Map.groupBy(frames, questionOf(frames));
  const isTimed = (cell) => cell.times.whole;
  const names = [...scenes.keys()].filter((name) => distinct(scenes.get(name).filter(isTimed), "frame").length > 1);
  if (!names.length) {
    return null;
  }
  const cells = names.flatMap((name) => scenes.get(name));
  const stages = [...new Set(cells.flatMap((cell) => Object.keys(cell.times)))];
  const counters = Object.keys(COUNTED).filter((key) => cells.some((cell) => key in cell.counters));
  const stageName = (stage) => (stage === "whole" ? "whole frame" : stage);
  const choices = {
    Scene: names,
    Show: [...stages.map((stage) => [stage, stageName(stage)]), ...counters.map((key) => [key, COUNTED[key]])],
    Scale: [["linear", "linear, from 0"], ["log", "logarithmic"]],
  };
  return new Chart("Time a frame", file, choices, (scene, show, scale) => {
    const here = scenes.get(scene);
    const isTime = !(show in COUNTED);
    const stage = isTime ? show : "whole";
    const timed = here.filter((cell) => cell.times[stage]);
    const unit = isTime ? unitFor(timed.map((cell) => cell.times[stage][1])) : ["", 1];
    const value = (cell) => (isTime ? cell.times[show][1] / unit[1] : cell.counters[show]);
    const traces = [...Map.groupBy(here, (cell) => cell.who)]
      .map(([name, group]) => {
        const points = group.sort((a, b) => a.frame - b.frame);
        return scatter(name, file.looks[name], points, stage, {
          mode: points.length > 60 ? "lines" : "lines+markers",
          connectgaps: false,
          x: points.map((cell) => cell.frame),
          y: points.map((cell) => (cell.times[stage] ? value(cell) : null)),
          marker: {size: 6},
          hovertemplate: `frame %{x}<br>%{y:,.4g} ${unit[0]}<extra>%{fullData.name}</extra>`,
        });
      })
      .filter((trace) => trace.y.some((y) => y !== null));
    const last = Math.max(...here.map((cell) => cell.frame));
    const drawn = traces.flatMap((trace) => trace.y);
    const isLog = scale === "log" && drawn.every((y) => y === null || y > 0);
    const title = isTime ? `${stageName(show)}, ${unit[0]}` : COUNTED[show];
    return {
      traces,
      cells: here,
      asked: here,
      layout: {
        height: 430,
        xaxis: axis("frame", null, {tickformat: "d", dtick: Math.max(1, Math.ceil(last / 12))}),
        yaxis: axis(title, isLog ? drawn : null, {tickformat: ",.4~r", rangemode: "tozero"}),
      },
      notes: [isTime ? "Medians of each frame." : ""],
    };
  });
}
