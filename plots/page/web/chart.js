// SPDX-License-Identifier: MIT
// Shared by all charts: a card with menus, a legend of buttons, and a Plotly drawing that is made when it comes into view.
const seen = new IntersectionObserver(drawSeen, {rootMargin: "300px"});

function drawSeen(entries) {
  for (const {target} of entries.filter((one) => one.isIntersecting)) {
    seen.unobserve(target);
    target.chart.draw();
  }
}

// Narrow windows break long names and dark pages have other colours, so charts are redrawn when this changes.
const narrow = matchMedia("(max-width: 600px)");
for (const query of [narrow, dark]) {
  query.addEventListener("change", () =>
    document.querySelectorAll(".drawing.drawn").forEach((drawing) => drawing.chart.draw())
  );
}

async function drawPlot(plot, traces, layout, modeBar) {
  await Plotly.react(plot, traces, layoutOf(layout), {
    displaylogo: false,
    displayModeBar: modeBar,
    responsive: true,
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
  });
  plot.classList.add("drawn");
}

class Chart {
  /**
   * `choices`: options by label, as for menu. `draw` returns for the chosen options {traces, layout, notes, cells, legend, asked}: the
   * drawn cells, entries of the legend if they are not those of the cells, and all cells that were asked for if some are not drawn.
   */
  constructor(title, file, choices, draw) {
    this.file = file;
    this.drawing = draw;
    this.selects = Object.values(choices).map((options) => menu(options, () => this.draw()));
    const shownChoices = Object.keys(choices).map((label, k) => {
      const {options} = this.selects[k];
      return options.length > 1
        ? element("label", {}, label + " ", this.selects[k])
        : element("span", {class: "only"}, label + " ", element("b", {}, options[0].textContent));
    });
    this.plot = element("div", {class: "drawing", role: "img", "aria-label": title});
    this.legend = element("div", {class: "legend", role: "group", "aria-label": "Legend: press to hide or show"});
    this.notes = element("div", {class: "note"});
    const head = element("figcaption", {}, element("h3", {}, title));
    const controls = element("div", {class: "controls"}, ...shownChoices);
    this.element = element("figure", {class: "chart"}, head, controls, this.plot, this.legend, this.notes);
    this.plot.chart = this;
    seen.observe(this.plot);
  }

  async draw() {
    await libraryOf("plotly");
    const {traces, layout, notes, cells, asked = [], ...more} = this.drawing(...this.selects.map((select) => select.value));
    const star = cells.some((cell) => cell.is_stand_in) ? this.file.star + "." : "";
    const said = [...notes, ...missingNotes(asked), star].filter(Boolean);
    this.hidden = new Set();
    this.legend.replaceChildren(...(more.legend || legendOf(cells, this.file.looks)).map((entry) => this.entry(entry)));
    this.notes.replaceChildren(...said.map((note) => element("p", {}, note)));
    this.plot.style.height = layout.height + "px";
    const isFirst = !this.plot.classList.contains("drawn");
    await drawPlot(this.plot, traces, layout, narrow.matches ? false : "hover");
    if (isFirst) {
      this.plot.on("plotly_click", ({points: [{data, pointIndex}]}) => {
        location.hash = data.leads?.[pointIndex] || location.hash;
      });
    }
  }

  /** Creates a button that hides and shows the traces that `isOf` chooses; by default those of its name. */
  entry({name, look, isOf = (trace) => trace.name === name}) {
    const toggle = ({currentTarget}) => {
      const isShown = this.hidden.delete(isOf);
      if (!isShown) {
        this.hidden.add(isOf);
      }
      currentTarget.setAttribute("aria-pressed", isShown);
      const isHidden = (trace) => [...this.hidden].some((one) => one(trace));
      Plotly.restyle(this.plot, {visible: this.plot.data.map((trace) => (isHidden(trace) ? "legendonly" : true))});
    };
    return button({"aria-pressed": true, click: toggle}, swatch(look), name);
  }
}
