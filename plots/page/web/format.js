// SPDX-License-Identifier: MIT
// Formats numbers as text, and creates elements of the page.
const WITHOUT_TIMES = ["differs", "failed", "skipped"];
const UNITS = [
  ["s", 1e9],
  ["ms", 1e6],
  ["µs", 1e3],
  ["ns", 1],
];

/** Returns four significant digits, with an exponent only for very large or small numbers. */
function four(value) {
  const size = Math.abs(value);
  if (value === 0) {
    return "0";
  }
  if (size >= 1e3 && size < 1e15) {
    return Math.round(value).toLocaleString("en");
  }
  return size >= 1e-4 && size < 1e3 ? value.toPrecision(4) : value.toExponential(3);
}

function shown(value, kind) {
  if (value === null || value === undefined || value === "") {
    return "–";
  }
  if (kind === "count") {
    return value.toLocaleString("en", {maximumFractionDigits: 3});
  }
  if (kind === "share") {
    return typeof value === "string" ? value : (100 * value).toFixed(1) + " %";
  }
  return typeof value === "number" ? four(value) : value;
}

/** Returns the unit [name, nanoseconds] in which the median of the times is at least 1. */
function unitFor(times) {
  const sorted = [...times].sort((a, b) => a - b);
  const middle = sorted[sorted.length >> 1] || 1;
  return UNITS.find((unit) => middle >= unit[1]) || UNITS[3];
}

/** element("a", {href: "#"}, "text", child): creates an element. Attributes that are functions become event handlers. */
function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (typeof value === "function") {
      made.addEventListener(name, value);
    } else if (value !== null && value !== false) {
      made.setAttribute(name, value === true ? "" : value);
    }
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Creates a menu of options, each a value or [value, text]. `change` is called with the chosen value. */
function menu(options, change) {
  const pairs = options.map((option) => (Array.isArray(option) ? option : [option, option]));
  const texts = pairs.map(([value, text]) => element("option", {value}, text));
  const made = element("select", {change: () => change(made.value)}, ...texts);
  return made;
}

/** Shows a verdict by word and border, not by colour alone. A library's failure is told apart from one of ours. */
function badge(state, isOfLibrary) {
  const kind = "state state-" + String(state).split(/[ :]/)[0] + (isOfLibrary ? " of-library" : "");
  return element("span", {class: kind}, String(state).replace("_", " "));
}

/** Returns "of libraries: FCL 60, Embree 9", with "all " or the number in front, for the counts of a state; "" without any. */
function ofLibraries({count, libraries}) {
  const named = Object.entries(libraries).sort(([, one], [, other]) => other - one);
  const theirs = named.reduce((sum, [, number]) => sum + number, 0);
  const said = named.map(([name, number]) => `${name} ${number.toLocaleString("en")}`).join(", ");
  return theirs ? `${theirs === count ? "all" : theirs.toLocaleString("en")} of libraries: ${said}` : "";
}

function download(name, lines) {
  const link = element("a", {
    download: name,
    href: URL.createObjectURL(new Blob([lines.join("\n") + "\n"], {type: "text/csv"})),
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Formats a CSV value. A text that a spreadsheet would take for a formula gets an apostrophe in front. */
function csvCell(value) {
  const text = String(value ?? "");
  const harmless = typeof value === "string" && /^[=+\-@\t\r]/.test(text) ? "'" + text : text;
  return /[",\r\n]/.test(harmless) ? `"${harmless.replace(/"/g, '""')}"` : harmless;
}

function csvLine(values) {
  return values.map(csvCell).join(",");
}

function plural(count, word) {
  return `${count.toLocaleString("en")} ${word}${count === 1 ? "" : "s"}`;
}
