// SPDX-License-Identifier: MIT
// A scene in three dimensions: its triangles, colliding ones in colour, and the boxes of a chosen level of a tree.
const SCENE = {
  plain: "#b9bec4",
  pair: "#F0C060",
  contact: "#D55E00",
  inner: "#0072B2",
  leaf: "#009E73",
};
const SEEN_FROM = [0.55, 0.5, 1];
const FIELD = 25; // degrees: a small field of view distorts little
const DISTANCE = 3.9; // in radii of the scene, for a canvas that is as wide as high

const EDGES = [0, 1, 1, 3, 3, 2, 2, 0, 4, 5, 5, 7, 7, 6, 6, 4, 0, 4, 1, 5, 2, 6, 3, 7]; // corners by bits: x 1; y 2; z 4

/** Returns triangles without shared corners, so that each has its own normal and colour. */
function trianglesGeometry(points, faces, colourOf) {
  const positions = new Float32Array(faces.length * 3);
  const colours = new Float32Array(faces.length * 3);
  for (let k = 0; k < faces.length; ++k) {
    positions.set(points.subarray(3 * faces[k], 3 * faces[k] + 3), 3 * k);
    const colour = colourOf(Math.floor(k / 3));
    colours.set([colour.r, colour.g, colour.b], 3 * k);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Returns the edges of boxes `first` to `end` - 1; a box is min x, y, z, max x, y, z. */
function boxesGeometry(sides, first, end) {
  const positions = new Float32Array((end - first) * EDGES.length * 3);
  let place = 0;
  for (let box = first; box < end; ++box) {
    for (const corner of EDGES) {
      for (let axis = 0; axis < 3; ++axis) {
        positions[place++] = sides[6 * box + axis + ((corner >> axis) & 1 ? 3 : 0)];
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  return geometry;
}

/** Returns 1 for each triangle that is in a pair, otherwise 0. */
function marks(pairs, count) {
  const found = new Uint8Array(count);
  pairs.forEach((triangle) => {
    found[triangle] = 1;
  });
  return found;
}

class View {
  /** `facts` as returned by plots/page/circumstances.py; arrays are unpacked when the view comes into sight. */
  constructor(facts, number) {
    this.facts = facts;
    this.number = number;
    this.level = Math.min(facts.levels.length - 1, 6);
    this.canvas = element("canvas", {role: "img", "aria-label": `${facts.scene} in three dimensions`, tabindex: "0"});
    this.said = element("output", {class: "note"});
    this.slider = element("input", {
      type: "range",
      min: 0,
      max: Math.max(0, facts.levels.length - 1),
      step: 1,
      value: this.level,
      input: () => this.show(),
    });
    this.triangles = menu(["all", ["some", "those that collide"], "none"], () => this.show());
    this.hasBoxes = element("input", {type: "checkbox", checked: true, change: () => this.show()});
    this.element = element(
      "figure",
      {class: "view"},
      element("figcaption", {}, element("h3", {}, this.title()), this.verdict()),
      element(
        "div",
        {class: "controls"},
        element("label", {}, "Level ", this.slider),
        this.said,
        element("label", {}, this.hasBoxes, " Boxes"),
        element("label", {}, "Triangles ", this.triangles)
      ),
      element("div", {class: "canvas"}, this.canvas),
      this.legend()
    );
    this.canvas.chart = this;
    seen.observe(this.canvas);
  }

  title() {
    const {facts} = this;
    const frame = facts.frame ? `, frame ${facts.frame}` : "";
    return `${facts.scene}${frame}: ${plural(facts.triangles, "triangle")}, ${facts.who}`;
  }

  verdict() {
    const {facts} = this;
    const sentences = [
      ` with ${facts.against}${facts.why ? `: ${facts.why}` : ""}.`,
      `${plural(facts.pairs, "pair")} of triangles have boxes that overlap,`,
      `${facts.contacts.toLocaleString("en")} intersect; neighbours that share a vertex are left out. Built and queried on`,
      `${facts.device}, commit ${facts.commit.slice(0, 10)}${facts.dirty ? " with local changes" : ""}.`,
    ];
    return element("p", {}, badge(facts.state), sentences.join(" "));
  }

  legend() {
    const entries = [
      ["contact", "intersects another triangle"],
      ["pair", "its box overlaps another's"],
      ["inner", "box of an inner node"],
      ["leaf", "box of a leaf"],
    ];
    const shown = entries.map(([key, text]) => element("span", {}, swatch({colour: SCENE[key], symbol: "square"}), text));
    return element("p", {class: "legend plain"}, ...shown);
  }

  /** Draws the scene when it comes into view. Shows a warning if there is no WebGL. */
  async draw() {
    await libraryOf("three");
    try {
      this.renderer = new THREE.WebGLRenderer({canvas: this.canvas, antialias: true, preserveDrawingBuffer: true});
    } catch (error) {
      const said = "This browser draws nothing in three dimensions: WebGL is switched off or missing.";
      this.element.append(element("p", {class: "warning"}, said));
      return;
    }
    await this.fill();
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(this.middle);
    this.controls.addEventListener("change", () => this.render());
    this.controls.update();
    dark.addEventListener("change", () => {
      this.paint();
      this.render();
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    this.show();
    this.resize();
    this.canvas.classList.add("drawn");
  }

  async fill() {
    const name = (array) => `view-${this.number}-${array}`;
    const [points, boxes] = await Promise.all(["points", "boxes"].map((one) => arrayOf(name(one), Float32Array)));
    const [faces, pairs, contacts] = await Promise.all(
      ["faces", "pairs", "contacts"].map((one) => arrayOf(name(one), Uint32Array))
    );
    this.boxes = boxes;
    const [inPair, inContact] = [marks(pairs, faces.length / 3), marks(contacts, faces.length / 3)];
    const colours = Object.fromEntries(Object.entries(SCENE).map(([key, value]) => [key, new THREE.Color(value)]));
    const material = () =>
      new THREE.MeshLambertMaterial({
        vertexColors: THREE.VertexColors,
        side: THREE.DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
    const colouring = (triangle) =>
      inContact[triangle] ? colours.contact : inPair[triangle] ? colours.pair : colours.plain;
    const some = faces.filter((_, k) => inPair[Math.floor(k / 3)] || inContact[Math.floor(k / 3)]);
    const places = [...inPair.keys()].filter((triangle) => inPair[triangle] || inContact[triangle]);
    this.mesh = new THREE.Mesh(trianglesGeometry(points, faces, colouring), material());
    this.part = new THREE.Mesh(trianglesGeometry(points, some, (k) => colouring(places[k])), material());
    this.lines = ["inner", "leaf"].map(
      (kind) => new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: SCENE[kind]}))
    );
    this.scene = new THREE.Scene();
    this.paint();
    this.camera = new THREE.PerspectiveCamera(FIELD, 1, 0.01, 100);
    const lamp = new THREE.DirectionalLight("#ffffff", 0.6);
    lamp.position.set(0.5, 1, 0.8);
    this.camera.add(lamp);
    this.scene.add(this.camera, new THREE.AmbientLight("#ffffff", 0.55), this.mesh, this.part, ...this.lines);
    this.place();
  }

  /** Gives the scene the page's background. */
  paint() {
    this.scene.background = new THREE.Color(colour("card"));
  }

  /** Places the camera so that the whole scene is visible, whatever its size. */
  place() {
    this.mesh.geometry.computeBoundingSphere();
    const {center, radius} = this.mesh.geometry.boundingSphere;
    const size = radius || 1;
    this.middle = center;
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    const distance = (DISTANCE * size) / Math.min(1, clientWidth / clientHeight);
    this.camera.position.copy(center).add(new THREE.Vector3(...SEEN_FROM).normalize().multiplyScalar(distance));
    this.camera.near = size / 100;
    this.camera.far = size * 100;
  }

  show() {
    this.level = Number(this.slider.value);
    const level = this.facts.levels[this.level] || {count: 0, leaves: 0};
    this.said.textContent = this.facts.levels.length
      ? `${this.level} of ${this.facts.levels.length - 1}: ${plural(level.count, "box").replace("boxs", "boxes")}, ` +
        `${level.leaves.toLocaleString("en")} of leaves`
      : "no boxes: the tree is wrong";
    if (!this.scene) {
      return;
    }
    const first = this.facts.levels.slice(0, this.level).reduce((sum, one) => sum + one.count, 0);
    const leaves = first + level.count - level.leaves;
    [[first, leaves], [leaves, first + level.count]].forEach(([from, to], k) => {
      this.lines[k].geometry.dispose();
      this.lines[k].geometry = boxesGeometry(this.boxes, from, to);
      this.lines[k].visible = this.hasBoxes.checked;
    });
    this.mesh.visible = this.triangles.value === "all";
    this.part.visible = this.triangles.value === "some";
    this.render();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
}
