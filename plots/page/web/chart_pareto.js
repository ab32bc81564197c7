// SPDX-License-Identifier: MIT
// Time against quality or error. Points of the Pareto front are filled and joined.
/** A logarithmic axis has no 0, so 0 is drawn one step below the smallest positive value and labelled 0. */
function withZero(values) {
  const least = Math.min(...values.filter((value) => value > 0));
  const most = Math.max(...values);
  if (!values.includes(0) || !Number.isFinite(least)) {
    const more = {rangemode: "nonnegative", ...(most > 0 ? {} : {range: [-0.05, 1]})};
    return {place: (value) => value, log: isWide(values) ? values : null, more: isWide(values) ? {} : more};
  }
  const [first, last] = [Math.floor(Math.log10(least)), Math.ceil(Math.log10(most))];
  const step = Math.max(1, Math.ceil((last - first) / 6));
  const powers = Array.from({length: 1 + Math.floor((last - first) / step)}, (_, k) => last - k * step).reverse();
  const zero = 10 ** (first - step);
  const named = (power) => (power >= -3 && power <= 4 ? String(10 ** power) : `1e${power}`);
  return {
    place: (value) => value || zero,
    log: [zero, most],
    more: {
      dtick: undefined,
      tickvals: [zero, ...powers.map((power) => 10 ** power)],
      ticktext: ["0", ...powers.map(named)],
    },
  };
}

function paretoChart(file) {
  const scenes = Map.groupBy(file.cells, questionOf(file.cells));
  const shownOf = (scene, measure) => scenes.get(scene).filter((cell) => cell.times.whole && measure in cell.measures);
  const isUseful = (scene, measure) => new Set(shownOf(scene, measure).map((cell) => cell.measures[measure])).size > 1;
  const all = [...new Set(file.cells.flatMap((cell) => Object.keys(cell.measures || {})))];
  const names = [...scenes.keys()].filter((scene) => all.some((measure) => isUseful(scene, measure)));
  const measures = all.filter((measure) => names.some((scene) => isUseful(scene, measure)));
  if (!measures.length) {
    return null;
  }
  return new Chart("Time against quality or error", file, {Scene: names, Against: measures}, (scene, measure) => {
    if (!isUseful(scene, measure)) {
      return {traces: [], cells: [], layout: {height: 120}, notes: [`On ${scene} none differs in ${measure}.`]};
    }
    const here = shownOf(scene, measure);
    const times = here.map((cell) => cell.times.whole[1]);
    const unit = unitFor(times);
    const zero = withZero(here.map((cell) => cell.measures[measure]));
    const placesOf = (cells) => ({
      x: cells.map((cell) => cell.times.whole[1] / unit[1]),
      y: cells.map((cell) => zero.place(cell.measures[measure])),
    });
    const isBest = (cell) => cell.front.includes(measure);
    const front = here.filter(isBest).sort((a, b) => a.times.whole[1] - b.times.whole[1]);
    const joined = {type: "scatter", mode: "lines", line: {color: "#888888", width: 1}, hoverinfo: "skip", name: "front"};
    const dots = [...Map.groupBy(here, (cell) => cell.who)].map(([name, cells]) => {
      const look = themed(file.looks[name]);
      return scatter(name, look, cells, "whole", {
        mode: "markers",
        ...placesOf(cells),
        customdata: cells.map((cell) => four(cell.measures[measure])),
        marker: {
          size: 10,
          symbol: cells.map((cell) => look.symbol + (isBest(cell) ? "" : "-open")),
          line: {
            width: cells.map((cell) => (isBest(cell) ? 0.6 : 1.6)),
            color: cells.map((cell) => (isBest(cell) ? colour("ink") : look.colour)),
          },
        },
        hovertemplate: `%{x:.4g} ${unit[0]}<br>${measure}: %{customdata}<extra>%{fullData.name}</extra>`,
      });
    });
    return {
      traces: [{...joined, ...placesOf(front)}, ...dots],
      cells: here,
      asked: scenes.get(scene),
      layout: {
        height: 430,
        xaxis: axis(`time, ${unit[0]}`, isWide(times) ? times : null, {tickformat: ",.4~r"}),
        yaxis: axis(measure, zero.log, {tickformat: ",.4~r", ...zero.more}),
      },
      notes: ["Down and left is better. Filled, joined: no other is as good in both. Medians."],
    };
  });
}
