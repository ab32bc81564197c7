// SPDX-License-Identifier: MIT
// A table that is sorted by its headers and filtered by words and menus.
const ROWS_AT_FIRST = 100;
const MOST_CHOICES = 60;
const SHORT = 24; // characters: a column without longer texts does not wrap
const WITHOUT_TIMES = ["differs", "failed", "skipped"];
const words = new Intl.Collator("en", {numeric: true});

function isMissing(value) {
  return value === null || value === "";
}

/** Orders numbers, then texts. */
function compared(a, b) {
  const [isText, isOther] = [a, b].map((value) => typeof value !== "number");
  return isText - isOther || (isText ? words.compare(a, b) : a - b);
}

class SortedTable {
  /** `data` as returned by plots/page/tables.py; `file` is the file's number in links to samples. */
  constructor(data, file) {
    this.data = data;
    this.file = file;
    this.order = [-1, 0]; // column, and 1 or -1; 0: as the file is
    this.most = ROWS_AT_FIRST;
    this.choices = new Map();
    const texts = data.rows.map((row) => row.map((value, k) => shown(value, data.columns[k].kind)));
    this.text = texts.map((row) => row.join(" ").toLowerCase());
    this.short = data.columns.map((_, k) => texts.every((row) => row[k].length <= SHORT));
    this.libraries = new Set(data.libraries);
    this.firstTime = data.columns.findIndex((column) => column.kind === "time");
    this.state = data.columns.findIndex((column) => column.kind === "state");
    this.count = element("span", {class: "count", "aria-live": "polite"});
    this.body = element("tbody", {});
    const showAll = () => {
      this.most = Infinity;
      this.fill();
    };
    this.more = button({class: "more", click: showAll});
    this.heads = data.columns.map((column, k) => this.head(column, k));
    const table = element("table", {}, element("thead", {}, element("tr", {}, ...this.heads)), this.body);
    const box = element("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": data.title}, table);
    this.element = element("div", {class: "table"}, this.controls(), box, this.more);
    this.fill();
  }

  head(column, k) {
    const unit = column.unit ? element("span", {class: "unit"}, column.unit) : null;
    const arrow = element("span", {class: "arrow", "aria-hidden": "true"});
    const sorts = button({click: () => this.sort(k)}, column.label + "\u00a0", arrow, unit);
    return element("th", {scope: "col", class: "kind-" + column.kind, "aria-sort": "none"}, sorts);
  }

  controls() {
    this.query = element("input", {type: "search", placeholder: "words, all of them", input: () => this.fill()});
    const choices = this.data.columns.map((column, k) => (column.facet ? this.choice(column, k) : null));
    const save = button({click: () => this.save()}, "CSV");
    const end = element("span", {class: "end"}, this.count, save);
    return element("div", {class: "controls"}, element("label", {}, "Filter ", this.query), ...choices, end);
  }

  choice(column, k) {
    const there = [...new Set(this.data.rows.map((row) => row[k]).filter((value) => !isMissing(value)))];
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
    const [column, direction] = this.order;
    this.order = column !== k ? [k, 1] : direction === 1 ? [k, -1] : [-1, 0];
    const way = this.order[1] === 1 ? "ascending" : "descending";
    this.heads.forEach((head, other) => head.setAttribute("aria-sort", other === this.order[0] ? way : "none"));
    this.fill();
  }

  /** Returns the indices of the matching rows, in sorted order. Rows without a value are last in both directions. */
  wanted() {
    const {rows} = this.data;
    const needles = this.query.value.toLowerCase().split(/\s+/);
    const isChosen = (row) => [...this.choices].every(([k, value]) => value === "" || row[k] === value);
    const isWanted = (i) => isChosen(rows[i]) && needles.every((needle) => this.text[i].includes(needle));
    const [k, direction] = this.order;
    const inOrder = (i, j) => {
      const [a, b] = [rows[i][k], rows[j][k]];
      return isMissing(a) || isMissing(b) ? isMissing(a) - isMissing(b) : direction * compared(a, b);
    };
    const found = [...rows.keys()].filter(isWanted);
    return direction ? found.sort(inOrder) : found;
  }

  fill() {
    const wanted = this.wanted();
    this.body.replaceChildren(...wanted.slice(0, this.most).map((i) => this.row(i)));
    this.count.textContent = `${counted(wanted.length)} of ${plural(this.data.rows.length, "row")}`;
    this.more.hidden = wanted.length <= this.most;
    this.more.textContent = `Show all ${counted(wanted.length)} rows`;
  }

  row(i) {
    const row = this.data.rows[i];
    const bad = WITHOUT_TIMES.find((state) => state === row[this.state]);
    const kind = bad === "skipped" ? "absent" : this.libraries.has(i) ? "of-library" : "bad";
    const entries = row.map((value, k) => {
      const attributes = {class: `kind-${this.data.columns[k].kind}${this.short[k] ? " short" : ""}`};
      const head = k === 0 ? {scope: "row"} : {};
      const isMissingTime = k === this.firstTime && value === null;
      return element(k === 0 ? "th" : "td", {...attributes, ...head}, this.content(isMissingTime && bad ? bad : value, k, i));
    });
    return element("tr", {class: bad ? kind : null}, ...entries);
  }

  /** Returns a value as it is shown: a state with a border, and what has samples as a link to them. */
  content(value, k, i) {
    const column = this.data.columns[k];
    const cells = column.cells || this.data.cells;
    if (value !== null && (column.kind === "state" || (column.kind === "time" && typeof value === "string"))) {
      return badge(value, this.libraries.has(i));
    }
    const toSamples = cells && column.stage ? `#cell=${this.file}.${cells[i]}.${column.stage}` : null;
    const href = column.links ? column.links[i] : toSamples;
    const text = shown(value, column.kind);
    return value !== null && href ? element("a", {href}, text) : text;
  }

  save() {
    const head = this.data.columns.map((column) => column.label + (column.unit ? ` (${column.unit})` : ""));
    const rows = this.wanted().map((i) => this.data.rows[i]);
    download(this.data.title.toLowerCase().replace(/\W+/g, "-") + ".csv", [head, ...rows]);
  }
}

/** Creates a table below its title. A folded table is created when it is opened. */
function tableSection(data, file) {
  const title = element("h3", {}, data.title);
  if (data.folded) {
    const details = element("details", {class: "titled"}, element("summary", {}, title));
    details.addEventListener("toggle", () => details.append(new SortedTable(data, file).element), {once: true});
    return details;
  }
  const note = data.note ? element("p", {class: "note"}, data.note) : null;
  return element("div", {class: "titled"}, title, note, new SortedTable(data, file).element);
}
