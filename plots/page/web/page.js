// SPDX-License-Identifier: MIT
// The page itself: its contents, the part that is shown, and the targets of links. Parts are created when first shown.
const made = new Set();
const BAD = ["differs", "failed", "skipped", "broken"];
const STATES = ["agrees", "counted", "not_checked", "holds", "refused", "differs", "broken", "failed", "skipped"];

function verdictsOf(states) {
  return STATES.filter((state) => states[state]).map((state) => {
    const {count} = states[state];
    const theirs = BAD.includes(state) ? ofLibraries(states[state]) : "";
    const said = ` ${count.toLocaleString("en")}${theirs ? `, ${theirs}` : ""}`;
    return element("span", {class: "tally"}, badge(state, theirs.startsWith("all")), said);
  });
}

function runsTable(files) {
  const bad = (file) =>
    BAD.filter((state) => file.states[state])
      .map((state) => [`${file.states[state].count} ${state}`, ofLibraries(file.states[state])].filter(Boolean).join(", "))
      .join("; ");
  const plain = ["device", "driver", "commit", "options", "machine", "processor", "started"];
  const columns = [
    ["file", "text", (file) => file.title],
    ["experiments", "text", (file) => file.experiments.join(", ")],
    ["cells", "count", (file) => file.count],
    ["wrong or missing", "text", (file) => bad(file) || null],
    ...plain.map((key) => [key, "text", (file) => file[key]]),
  ];
  const data = {
    title: "What was run on what",
    cells: null,
    rows: files.map((file) => columns.map(([, , value]) => value(file))),
    columns: columns.map(([label, kind], k) => ({
      label,
      kind,
      facet: ["device", "experiments", "commit"].includes(label),
      links: k === 0 ? files.map((_, number) => "#file-" + number) : null,
    })),
  };
  return tableSection(data, 0);
}

/** Returns the figures that a brief page has in place of charts. */
async function pictures(number) {
  return (await jsonOf("pictures-" + number)).map(([name, svg]) => {
    const src = URL.createObjectURL(new Blob([svg], {type: "image/svg+xml"}));
    return element("figure", {class: "chart drawn"}, element("figcaption", {}, element("h3", {}, name)), element("img", {src, alt: ""}));
  });
}

/** Creates a file's tables and charts the first time it is shown. */
async function makeFile(number, head) {
  if (made.has(number)) {
    return;
  }
  made.add(number);
  const part = document.getElementById("file-" + number);
  const file = await jsonOf("file-" + number);
  file.cells.forEach((cell, place) => Object.assign(cell, {file: number, place}));
  part.querySelector(".verdicts").append(...verdictsOf(file.states));
  const charts = document.getElementById("blob-pictures-" + number)
    ? await pictures(number)
    : [sizeChart(file), stagesChart(file, head.stages), paretoChart(file), framesChart(file)]
        .filter(Boolean)
        .map((chart) => chart.element);
  part.querySelector(".charts").append(...charts);
  const tables = file.tables.map((table) => tableSection(table, number));
  const missing = file.tables.findIndex((table) => table.title.startsWith("Without") && !table.folded);
  if (missing >= 0) {
    part.querySelector(".verdicts").after(tables.splice(missing, 1)[0]);
  }
  part.querySelector(".tables").append(...tables);
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
    await makeFile(Number(name.slice(5)), head);
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
  await show(document.getElementById(target) && target ? target : "overview", head);
}

async function start() {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("This page needs a browser of 2023 or later: it unpacks its data with DecompressionStream.");
  }
  const head = await jsonOf("head");
  Object.assign(inTheDark, head.dark);
  const links = [["overview", "Overview"], ...head.files.map((file, k) => ["file-" + k, file.title])];
  document.getElementById("files").append(...links.map(([id, text]) => element("a", {href: "#" + id}, text)));
  if (head.best) {
    document.getElementById("best").append(tableSection(head.best, 0));
  }
  if (head.files.length) {
    document.getElementById("runs").append(runsTable(head.files));
  }
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
