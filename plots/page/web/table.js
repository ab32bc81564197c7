// SPDX-License-Identifier: MIT
// A table that is sorted by its headers and filtered by words and menus.
const ROWS_AT_FIRST = 100;
const MOST_CHOICES = 60;
const SHORT = 24; // characters: a column without longer texts does not wrap
const words = new Intl.Collator("en", {numeric: true});

/** Orders numbers, then texts. */
function compared(a, b) {
  const [isText, isOther] = [a, b].map((value) => typeof value !== "number");
  return isText && isOther ? words.compare(a, b) : isText || isOther ? isText - isOther : a - b;
}

class SortedTable {
  /** `data` as returned by plots/page/tables.py; `file` is the file's number in links to samples. */
  constructor(data, file) {
    this.data = data;
    this.file = file;
    this.order = null; // [column, 1 or -1], or null
    this.all = false;
    this.choices = new Map();
    const texts = data.rows.map((row) => row.map((value, k) => shown(value, data.columns[k].kind)));
    this.text = texts.map((row) => row.join(" ").toLowerCase());
    this.short = data.columns.map((_, k) => texts.every((row) => row[k].length <= SHORT));
    this.libraries = new Set(data.libraries);
    this.firstTime = data.columns.findIndex((column) => column.kind === "time");
    this.state = data.columns.findIndex((column) => column.kind === "state");
    this.count = element("span", {class: "count", "aria-live": "polite"});
    this.body = element("tbody");
    const showAll = () => {
      this.all = true;
      this.fill();
    };
    this.more = element("button", {type: "button", class: "more", click: showAll});
    this.heads = data.columns.map((column, k) => this.head(column, k));
    const table = element("table", {}, element("thead", {}, element("tr", {}, ...this.heads)), this.body);
    const box = element("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": data.title}, table);
    this.element = element("div", {class: "table"}, this.controls(), box, this.more);
    this.fill();
  }

  head(column, k) {
    const unit = column.unit ? element("span", {class: "unit"}, column.unit) : null;
    const arrow = element("span", {class: "arrow", "aria-hidden": "true"});
    const button = element("button", {type: "button", click: () => this.sort(k)}, column.label + "\u00a0", arrow, unit);
    return element("th", {scope: "col", class: "kind-" + column.kind, "aria-sort": "none"}, button);
  }

  controls() {
    this.query = element("input", {type: "search", placeholder: "words, all of them", input: () => this.fill()});
    const choices = this.data.columns.map((column, k) => (column.facet ? this.choice(column, k) : null));
    return element(
      "div",
      {class: "controls"},
      element("label", {}, "Filter ", this.query),
      ...choices,
      element("span", {class: "end"}, this.count, element("button", {type: "button", click: () => this.save()}, "CSV"))
    );
  }

  choice(column, k) {
    const there = [...new Set(this.data.rows.map((row) => row[k]).filter((value) => value !== null && value !== ""))];
    if (there.length < 2 || there.length > MOST_CHOICES) {
      return null;
    }
    const choose = (value) => {
      this.choices.set(k, value);
      this.fill();
    };
    return element("label", {}, column.label + " ", menu([["", "all"], ...there.sort(words.compare)], choose));
  }

  /** Sorts by column k: ascending first, then descending, then in the original order. */
  sort(k) {
    const [column, direction] = this.order || [-1, 0];
    this.order = column !== k ? [k, 1] : direction === 1 ? [k, -1] : null;
    const way = this.order && this.order[1] === 1 ? "ascending" : "descending";
    this.heads.forEach((head, other) => head.setAttribute("aria-sort", this.order && other === k ? way : "none"));
    this.fill();
  }

  /** Returns the indices of the matching rows, in sorted order. Rows without a value are last in both directions. */
  wanted() {
    const needles = this.query.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = [];
    this.data.rows.forEach((row, i) => {
      const chosen = [...this.choices].every(([k, value]) => value === "" || row[k] === value);
      if (chosen && needles.every((needle) => this.text[i].includes(needle))) {
        found.push(i);
      }
    });
    if (this.order) {
      const [k, direction] = this.order;
      const missing = (value) => value === null || value === "";
      found.sort((i, j) => {
        const [a, b] = [this.data.rows[i][k], this.data.rows[j][k]];
        if (missing(a) || missing(b)) {
          return missing(a) - missing(b);
        }
        return direction * compared(a, b);
      });
    }
    return found;
  }

  fill() {
    const wanted = this.wanted();
    const here = this.all ? wanted : wanted.slice(0, ROWS_AT_FIRST);
    this.body.replaceChildren(...here.map((i) => this.row(i)));
    this.count.textContent = `${wanted.length.toLocaleString("en")} of ${plural(this.data.rows.length, "row")}`;
    this.more.hidden = here.length === wanted.length;
    this.more.textContent = `Show all ${wanted.length.toLocaleString("en")} rows`;
  }

  row(i) {
    const row = this.data.rows[i];
    const state = this.state < 0 ? "" : row[this.state];
    const isBad = WITHOUT_TIMES.includes(state);
    const kind = state === "skipped" ? "absent" : this.libraries.has(i) ? "of-library" : "bad";
    const entries = row.map((value, k) => {
      const column = this.data.columns[k];
      const attributes = {class: `kind-${column.kind}${this.short[k] ? " short" : ""}`, scope: k === 0 ? "row" : null};
      return element(k === 0 ? "th" : "td", attributes, this.content(value, column, i, isBad ? state : null));
    });
    return element("tr", {class: isBad ? kind : null}, ...entries);
  }

  content(value, column, i, bad) {
    if (column.kind === "state") {
      return value === null ? "–" : badge(value, this.libraries.has(i));
    }
    if (value === null && column === this.data.columns[this.firstTime] && bad) {
      return badge(bad, this.libraries.has(i));
    }
    if (value !== null && column.links && column.links[i]) {
      return element("a", {href: column.links[i]}, shown(value, column.kind));
    }
    const cells = column.cells || this.data.cells;
    if (value !== null && cells && column.stage) {
      return element("a", {href: `#cell=${this.file}.${cells[i]}.${column.stage}`}, shown(value, "time"));
    }
    return shown(value, column.kind);
  }

  save() {
    const head = csvLine(this.data.columns.map((column) => column.label + (column.unit ? ` (${column.unit})` : "")));
    download(this.data.title.toLowerCase().replace(/\W+/g, "-") + ".csv", [
      head,
      ...this.wanted().map((i) => csvLine(this.data.rows[i])),
    ]);
  }
}

/** Creates a table below its title. A folded table is created when it is opened. */
function tableSection(data, file) {
  const note = data.note ? element("p", {class: "note"}, data.note) : null;
  if (!data.folded) {
    return element("div", {class: "titled"}, element("h3", {}, data.title), note, new SortedTable(data, file).element);
  }
  const details = element("details", {class: "titled"}, element("summary", {}, element("h3", {}, data.title)));
  details.addEventListener("toggle", () => {
    if (details.children.length === 1) {
      details.append(new SortedTable(data, file).element);
    }
  });
  return details;
}
