// SPDX-License-Identifier: MIT
// The page itself: its contents, the part that is shown, and the targets of links. Parts are created when first shown.
/** Creates a file's tables and charts. */
async function makeFile(number, head) {
  const part = document.getElementById("file-" + number);
  const file = await jsonOf("file-" + number);
  file.cells.forEach((cell, place) => Object.assign(cell, {file: number, place}));
  part.querySelector(".circumstances").append(element("dl", {class: "facts"}, ...factsOf(file.run, "")));
  const tally = ({state, count, of}) => element("span", {class: "tally"}, badge(state, of.startsWith(", all")), ` ${count}${of}`);
  part.querySelector(".verdicts").append(...file.states.map(tally));
  const charts = [...(file.runs ? [] : [sizeChart(file), stagesChart(file, head.stages), paretoChart(file)]), framesChart(file)]
    .filter(Boolean)
    .map((chart) => chart.element);
  part.querySelector(".charts").append(...charts);
  for (const table of file.tables) {
    const isFirst = table.title.startsWith("Without") && !table.folded;
    part.querySelector(isFirst ? ".verdicts" : ".tables")[isFirst ? "after" : "append"](tableSection(table, number));
  }
}

async function show(name, head) {
  document.querySelectorAll("section.file").forEach((part) => {
    part.hidden = part.id !== name;
  });
  document.querySelectorAll("#files a").forEach((link) => {
    const isHere = link.getAttribute("href") === "#" + name;
    link.toggleAttribute("aria-current", isHere);
    if (isHere) {
      link.parentElement.scrollLeft = link.offsetLeft - link.parentElement.offsetLeft - 20;
    }
  });
  if (name.startsWith("file-")) {
    await once("part-" + name, () => makeFile(Number(name.slice(5)), head));
  }
}

/** Follows the location: #overview, #file-0, or #cell=0.17.sort (samples of cell 17 of file 0, stage sort). */
async function follow(head) {
  const target = decodeURIComponent(location.hash.slice(1));
  const cell = /^cell=(\d+)\.(\d+)\.(\w+)$/.exec(target);
  if (cell) {
    await show("file-" + cell[1], head);
    await showSamples(Number(cell[1]), Number(cell[2]), cell[3]);
    return;
  }
  document.getElementById("samples").close();
  await show(document.getElementById(target) ? target : "overview", head);
}

async function start() {
  if (!Map.groupBy) {
    throw new Error("This page needs a browser of 2024 or later: it groups its data by Map.groupBy.");
  }
  const head = await jsonOf("head");
  Object.assign(inTheDark, head.dark);
  const links = [["overview", "Overview"], ...head.titles.map((title, k) => ["file-" + k, title])];
  document.getElementById("files").append(...links.map(([id, text]) => element("a", {href: "#" + id}, text)));
  document.getElementById("overview-tables").append(...head.tables.map((table) => tableSection(table, 0)));
  document.getElementById("views").append(...head.views.map((facts, k) => new View(facts, k).element));
  // Closing the dialog returns to the part that it was opened over, and keeps the history intact.
  document.getElementById("samples").addEventListener("close", () => {
    if (location.hash.startsWith("#cell=")) {
      history.replaceState(null, "", "#file-" + location.hash.slice(6).split(".")[0]);
    }
  });
  addEventListener("hashchange", () => follow(head).catch(complain));
  await follow(head);
  document.body.classList.add("ready");
}

function complain(error) {
  const trouble = document.getElementById("trouble");
  trouble.textContent = error.message;
  trouble.hidden = false;
  throw error;
}

start().catch(complain);
