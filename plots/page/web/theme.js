// SPDX-License-Identifier: MIT
// Colours of charts and scenes: those of the page, light or dark.
const dark = matchMedia("(prefers-color-scheme: dark)");
const inTheDark = {}; // colours of figures that are too dark on a dark page, and their replacements; from report_looks.py

/** Returns a colour of base.css, such as colour("ink"). */
function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

/** Returns a look with a colour that can be seen on the page. */
function themed(look) {
  return {...look, colour: (dark.matches && inTheDark[look.colour]) || look.colour};
}
