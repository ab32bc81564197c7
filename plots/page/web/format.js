// SPDX-License-Identifier: MIT
// Formats numbers as text, and creates elements of the page.
const UNITS = {s: 1e9, ms: 1e6, µs: 1e3, ns: 1};

/** Returns four significant digits, with an exponent only for very large or small numbers. */
function four(value) {
  const size = Math.abs(value);
  if (value === 0) {
    return "0";
  }
  if (size >= 1e3 && size < 1e15) {
    return counted(Math.round(value));
  }
  return size >= 1e-4 && size < 1e3 ? value.toPrecision(4) : value.toExponential(3);
}

/** Returns all digits before the point, and three after it. */
function counted(value) {
  return value.toLocaleString("en", {maximumFractionDigits: 3});
}

function plural(number, word) {
  return `${counted(number)} ${word}${number === 1 ? "" : "s"}`;
}

function shown(value, kind) {
  if (typeof value !== "number") {
    return value || "–";
  }
  return kind === "count" ? counted(value) : kind === "share" ? (100 * value).toFixed(1) + " %" : four(value);
}

/** Returns the unit [name, nanoseconds] in which the median of the times is at least 1. */
function unitFor(times) {
  const sorted = [...times].sort((a, b) => a - b);
  const middle = sorted[sorted.length >> 1] || 1;
  return Object.entries(UNITS).find((unit) => middle >= unit[1]) || ["ns", 1];
}

/** element("a", {href: "#"}, "text", child): creates an element. Attributes that are functions become event handlers. */
function element(tag, attributes, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      made.addEventListener(name, value);
    } else if (value !== null) {
      made.setAttribute(name, value);
    }
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** Creates a menu of options, each a value or [value, text]. `change` is called with the chosen value. */
function menu(options, change) {
  const pairs = options.map((option) => [option].flat());
  const texts = pairs.map(([value, text = value]) => element("option", {value}, text));
  return element("select", {change: ({target}) => change(target.value)}, ...texts);
}

function button(attributes, ...children) {
  return element("button", {type: "button", ...attributes}, ...children);
}

/** Shows a verdict by word and border, not by colour alone. A library's failure is told apart from one of ours. */
function badge(state, isOfLibrary) {
  const kind = "state state-" + state.split(/[ :]/)[0] + (isOfLibrary ? " of-library" : "");
  return element("span", {class: kind}, state.replace("_", " "));
}

/** Saves rows as CSV. */
function download(name, rows) {
  const lines = rows.map((row) => row.map(csvCell).join(",") + "\n");
  const href = URL.createObjectURL(new Blob(lines, {type: "text/csv"}));
  element("a", {download: name, href}).click();
  setTimeout(() => URL.revokeObjectURL(href), 1000);
}

/** Formats a CSV value. A text that a spreadsheet would take for a formula gets an apostrophe in front. */
function csvCell(value) {
  const text = String(value ?? "");
  const harmless = typeof value === "string" && /^[=+\-@\t\r]/.test(text) ? "'" + text : text;
  return /[",\r\n]/.test(harmless) ? `"${harmless.replace(/"/g, '""')}"` : harmless;
}
