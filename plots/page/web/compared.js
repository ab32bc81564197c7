// SPDX-License-Identifier: MIT
// Cells that a chart compares: which are comparable, which have no times, their marks, and links to their samples.
/** Returns the different values that cells have of a key. */
function distinct(cells, key) {
  return [...new Set(cells.map((cell) => cell[key]))];
}

/** Returns the groups in which timed cells have more than `least` values of a key: their names, their cells, and the stages of these. */
function groupsThatVary(groups, key, least) {
  const isTimed = (cell) => cell.times.whole;
  const names = [...groups.keys()].filter((name) => distinct(groups.get(name).filter(isTimed), key).length > least);
  const cells = names.flatMap((name) => groups.get(name));
  return {names, cells, stages: [...new Set(cells.flatMap((cell) => Object.keys(cell.times)))]};
}

/** Returns a function that names a cell's question: its scene, and its experiment, axis and request where these vary. */
function questionOf(cells) {
  const ofScene = [...Map.groupBy(cells, (cell) => cell.scene).values()];
  const parts = ["experiment", "axis", "scene", "asked"].filter(
    (key) => key === "scene" || ofScene.some((group) => distinct(group, key).length > 1)
  );
  const named = (cell) => parts.map((key) => cell[key]).filter(Boolean);
  return (cell) => named(cell).join(" · ");
}

/** Returns sentences about the cells that are not drawn, and why. */
function missingNotes(cells) {
  const without = cells.filter((cell) => WITHOUT_TIMES.includes(cell.state));
  const groups = Map.groupBy(without, (cell) => `${cell.who} ${cell.state === "differs" ? "gave a wrong answer" : cell.state}`);
  const sentences = [...groups].map(([key, group]) => {
    const scenes = distinct(group, "scene");
    const more = scenes.length > 3 ? ` and ${scenes.length - 3} more` : "";
    return `${key} on ${scenes.slice(0, 3).join(", ")}${more}${group[0].why ? ": " + group[0].why : ""}.`;
  });
  const told = sentences.length ? ["Not drawn: " + sentences.slice(0, 4).join(" ")] : [];
  return sentences.length > 4 ? [...told, `And ${sentences.length - 4} more, in the table of what has no time.`] : told;
}

/** Returns a line or marks of cells in the given look. Each mark leads to the samples of a stage. */
function scatter(name, plain, cells, stage, {marker, ...more}) {
  const look = themed(plain);
  return {
    type: "scatter",
    name,
    leads: cells.map((cell) => leadTo(cell, stage)),
    line: {color: look.colour, dash: look.dash, width: 1.5},
    marker: {color: look.colour, symbol: look.symbol, line: {color: colour("ink"), width: 0.4}, ...marker},
    ...more,
  };
}

/** Returns the address of a cell's samples of a stage; nothing without a cell. */
function leadTo(cell, stage) {
  return cell ? `#cell=${cell.file}.${cell.place}.${stage}` : null;
}
