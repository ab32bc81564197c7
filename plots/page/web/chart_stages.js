// SPDX-License-Identifier: MIT
// Time by stage: one bar for each builder or pipeline, its stages stacked, as prepared by plots/page/cell_data.py.
const LONGEST = 12; // in multiples of the shortest bar: the initial end of the axis
const ROW = 38;
const BETWEEN = "between stages";

function shortened(text, most) {
  return text.length > most ? text.slice(0, most - 1) + "…" : text;
}

/** Returns a name broken into lines of at most `most` characters where possible. */
function broken(name, most) {
  return `${name} `.match(new RegExp(`.{1,${most}} |\\S+ `, "g")).map((line) => line.trim());
}

function stagesChart(file, stageLooks) {
  const question = questionOf(file.cells);
  const scenes = Map.groupBy(file.cells, question);
  const barsOf = Map.groupBy(file.bars, question);
  const useful = [...scenes].filter(([, cells]) => cells.some((cell) => cell.times.whole && cell.times.whole[1] > 0));
  if (!useful.length) {
    return null;
  }
  return new Chart("Time by stage", file, {Scene: useful.map(([name]) => name)}, (scene) => {
    const cells = scenes.get(scene);
    const bars = barsOf.get(scene);
    const timed = bars.filter((bar) => bar.stages);
    const wholes = timed.map((bar) => bar.whole);
    const unit = unitFor(wholes);
    const [limit, longest] = [LONGEST * Math.min(...wholes), Math.max(...wholes)];
    const there = Object.keys(stageLooks).filter((stage) => timed.some((bar) => bar.stages[stage]));
    const looks = Object.fromEntries(there.map((stage) => [stage, themed(stageLooks[stage])]));
    const labels = bars.map((bar) => broken(bar.who, narrow.matches ? 18 : 40));
    const traces = there.map((stage) => ({
      type: "bar",
      orientation: "h",
      name: stage,
      y: timed.map((bar) => bars.indexOf(bar)),
      x: timed.map((bar) => (bar.stages[stage] || 0) / unit[1]),
      width: 0.7,
      customdata: timed.map((bar) => bar.who),
      leads: timed.map((bar) => leadTo(file.cells[bar.cell], stage === BETWEEN ? "whole" : stage)),
      marker: {
        color: looks[stage].colour,
        line: {width: 0},
        pattern: {shape: stageLooks[stage].pattern, bgcolor: looks[stage].colour, fgcolor: "#ffffff", size: 6},
      },
      hovertemplate: `%{customdata}<br>%{x:.4g} ${unit[0]}<extra>%{fullData.name}</extra>`,
    }));
    const isOfLibrary = (bar) => cells.some((cell) => cell.who === bar.who && cell.library);
    const note = (bar) => ({
      x: 0,
      y: bars.indexOf(bar),
      xanchor: "left",
      showarrow: false,
      bgcolor: colour("card"),
      font: {color: colour(bar.said.startsWith("skipped") ? "quiet" : isOfLibrary(bar) ? "theirs" : "bad")},
      text: shortened(bar.said, narrow.matches ? 24 : 90),
    });
    const whole = (bar) => (bar.whole ? `<br><b>${four(bar.whole / unit[1])} ${unit[0]}</b>` : "");
    const frames = distinct(cells, "frame").length;
    const which = cells[0].operation === "collide" ? "frames after the first" : `${frames} frames`;
    const row = Math.max(ROW, 15 * (Math.max(...labels.map((lines) => lines.length)) + 1) + 6); // all as high as the highest
    return {
      traces,
      cells,
      legend: there.map((stage) => ({name: stage, look: {...stageLooks[stage], symbol: "square"}})),
      layout: {
        height: Math.max(150, 80 + row * bars.length),
        barmode: "stack",
        xaxis: axis(`time, ${unit[0]}`, null, {range: [0, (1.03 * Math.min(longest, limit)) / unit[1]]}),
        yaxis: {
          automargin: true,
          ticks: "outside",
          tickcolor: "rgba(0,0,0,0)",
          range: [bars.length - 0.4, -0.6],
          tickvals: bars.map((_, k) => k),
          fixedrange: true,
          ticktext: bars.map((bar, k) => labels[k].join("<br>") + whole(bar)),
        },
        annotations: bars.filter((bar) => bar.said).map(note),
      },
      notes: [
        frames > 1 ? `Means over ${which} of medians. Bold: the whole.` : "Medians. Bold: the whole.",
        longest > limit ? `The axis ends at ${LONGEST} times the shortest bar; a double click on the chart shows all.` : "",
      ],
    };
  });
}
