// SPDX-License-Identifier: MIT
// Cells that a chart compares: which are comparable, which have no times, and links to their samples.
function grouped(cells, keyOf) {
  const groups = new Map();
  for (const cell of cells) {
    const key = keyOf(cell);
    if (!groups.has(key)) {
      groups.set(key, []);
    }
    groups.get(key).push(cell);
  }
  return groups;
}

/** Returns a function that names a cell's question: its scene, and its experiment, axis and request where these vary. */
function questionOf(cells) {
  const ofScene = [...grouped(cells, (cell) => cell.scene).values()];
  const parts = ["experiment", "axis", "scene", "asked"].filter(
    (key) => key === "scene" || ofScene.some((group) => new Set(group.map((cell) => cell[key])).size > 1)
  );
  return (cell) =>
    parts
      .map((key) => cell[key])
      .filter(Boolean)
      .join(" · ");
}

/** Returns sentences about the cells that are not drawn, and why. */
function missingNotes(cells) {
  const groups = grouped(
    cells.filter((cell) => WITHOUT_TIMES.includes(cell.state)),
    (cell) => `${cell.who} ${cell.state === "differs" ? "gave a wrong answer" : cell.state}`
  );
  const sentences = [...groups].map(([key, group]) => {
    const scenes = [...new Set(group.map((cell) => cell.scene))];
    const more = scenes.length > 3 ? ` and ${scenes.length - 3} more` : "";
    return `${key} on ${scenes.slice(0, 3).join(", ")}${more}${group[0].why ? ": " + group[0].why : ""}.`;
  });
  const told = sentences.length ? ["Not drawn: " + sentences.slice(0, 4).join(" ")] : [];
  return sentences.length > 4 ? [...told, `And ${sentences.length - 4} more, in the table of what has no time.`] : told;
}

/** Returns the explanation of the star, if one of the scenes has one. */
function starNotes(file, cells) {
  return cells.some((cell) => cell.is_stand_in) ? [file.star + "."] : [];
}

/** Returns the links of marks to their samples: the cell and stage of each mark. */
function samplesOf(cells, stage) {
  return {leads: cells.map((cell) => (cell ? `#cell=${cell.file}.${cell.place}.${stage}` : null))};
}

function leadOn(point) {
  const {leads} = point.data;
  if (leads && leads[point.pointIndex]) {
    location.hash = leads[point.pointIndex];
  }
}
