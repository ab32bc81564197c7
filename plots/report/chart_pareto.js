// SPDX-License-Identifier: MIT
// Time against how good or how wrong: what no other is as good as in both is filled and joined.
/** A logarithmic axis has no 0: it is drawn a step below the least that is none, and called 0. */
function withZero(values) {
  const least = Math.min(...values.filter((value) => value > 0));
  const most = Math.max(...values);
  if (!values.includes(0) || !Number.isFinite(least)) {
    const more = {rangemode: "nonnegative", ...(most > 0 ? {} : {range: [-0.05, 1]})};
    return {place: (value) => value, log: isWide(values) ? values : null, more: isWide(values) ? {} : more};
  }
  const first = Math.floor(Math.log10(least));
  const last = Math.ceil(Math.log10(most));
  const step = Math.max(1, Math.ceil((last - first) / 6));
  const powers = [];
  for (let power = last; power >= first; power -= step) {
    powers.unshift(power);
  }
  const zero = 10 ** (first - step);
  return {
    place: (value) => (value === 0 ? zero : value),
    log: [zero, most],
    more: {
      dtick: undefined,
      tickvals: [zero, ...powers.map((power) => 10 ** power)],
      ticktext: ["0", ...powers.map((power) => (power >= -3 && power <= 4 ? String(10 ** power) : `1e${power}`))],
    },
  };
}

function paretoChart(file) {
  const scenes = grouped(file.cells, questionOf(file.cells));
  const points = new Map(); // by scene, by measure
  for (const [scene, cells] of scenes) {
    const byMeasure = {};
    for (const cell of cells.filter((one) => one.times.whole)) {
      for (const [measure, y] of Object.entries(cell.measures)) {
        (byMeasure[measure] = byMeasure[measure] || []).push({x: cell.times.whole[1], y, cell});
      }
    }
    const useful = Object.entries(byMeasure).filter(
      ([, found]) => new Set(found.map((point) => point.cell.who)).size > 1
    );
    if (useful.length) {
      points.set(scene, Object.fromEntries(useful));
    }
  }
  const measures = [...new Set([...points.values()].flatMap((found) => Object.keys(found)))];
  if (!measures.length) {
    return null;
  }
  return new Chart(
    "Time against quality or error",
    {Scene: [...points.keys()], Against: measures},
    (scene, measure) => {
      const here = points.get(scene)[measure] || [];
      if (!here.length) {
        return {traces: [], legend: [], layout: {height: 120}, notes: [`Nothing on ${scene} says its ${measure}.`]};
      }
      const unit = unitFor(here.map((point) => point.x));
      const front = here.filter((point) => point.cell.front.includes(measure)).sort((a, b) => a.x - b.x);
      const times = here.map((point) => point.x);
      const zero = withZero(here.map((point) => point.y));
      const line = {
        type: "scatter",
        mode: "lines",
        x: front.map((point) => point.x / unit[1]),
        y: front.map((point) => zero.place(point.y)),
        line: {color: "#888888", width: 1},
        hoverinfo: "skip",
        name: "front",
      };
      const dots = [...grouped(here, (point) => point.cell.who)].map(([name, group]) => {
        const look = file.looks[name];
        const cells = group.map((point) => point.cell);
        return scatter(name, look, cells, "whole", {
          mode: "markers",
          x: group.map((point) => point.x / unit[1]),
          y: group.map((point) => zero.place(point.y)),
          customdata: group.map((point) => four(point.y)),
          marker: {
            size: 10,
            symbol: group.map((point) => look.symbol + (front.includes(point) ? "" : "-open")),
            line: {
              width: group.map((point) => (front.includes(point) ? 0.6 : 1.6)),
              color: group.map((point) => (front.includes(point) ? INK : look.colour)),
            },
          },
          hovertemplate: `%{x:.4g} ${unit[0]}<br>${measure}: %{customdata}<extra>%{fullData.name}</extra>`,
        });
      });
      return {
        traces: [line, ...dots],
        legend: legendOf(here.map((point) => point.cell), file.looks),
        layout: {
          height: 430,
          xaxis: axis(`time, ${unit[0]}`, isWide(times) ? times : null, {tickformat: ",.4~r"}),
          yaxis: axis(measure, zero.log, {tickformat: ",.4~r", ...zero.more}),
        },
        notes: [
          "Down and left is better. Filled, joined: no other is as good in both. Medians.",
          ...missingNotes(scenes.get(scene)),
        ],
      };
    }
  );
}
