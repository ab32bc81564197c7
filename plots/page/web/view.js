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

function geometryOf(positions) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  return geometry;
}

/** Returns triangles without shared corners, so that each has its own normal and colour. */
function trianglesGeometry(points, faces, colourOf) {
  const shared = geometryOf(points);
  shared.setIndex(new THREE.BufferAttribute(faces, 1));
  const geometry = shared.toNonIndexed();
  const colours = new Float32Array(3 * faces.length);
  faces.forEach((_, k) => colourOf(Math.floor(k / 3)).toArray(colours, 3 * k));
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Returns the edges of boxes `first` to `end` - 1; a box is min x, y, z, max x, y, z. */
function boxesGeometry(sides, first, end) {
  const positions = [];
  for (let box = first; box < end; ++box) {
    for (const corner of EDGES) {
      positions.push(...[0, 1, 2].map((axis) => sides[6 * box + axis + ((corner >> axis) & 1 ? 3 : 0)]));
    }
  }
  return geometryOf(new Float32Array(positions));
}

class View {
  /** `facts` as returned by plots/page/circumstances.py; arrays are unpacked when the view comes into sight. */
  constructor(facts, number) {
    this.facts = facts;
    this.number = number;
    const deepest = facts.levels.length - 1;
    const range = {min: 0, max: Math.max(0, deepest), step: 1, value: Math.min(deepest, 6)};
    this.canvas = element("canvas", {role: "img", "aria-label": `${facts.scene} in three dimensions`, tabindex: "0"});
    this.said = element("output", {class: "note"});
    this.slider = element("input", {type: "range", ...range, input: () => this.show()});
    this.triangles = menu(["all", ["some", "those that collide"], "none"], () => this.show());
    this.hasBoxes = element("input", {type: "checkbox", checked: "", change: () => this.show()});
    const controls = element(
      "div",
      {class: "controls"},
      element("label", {}, "Level ", this.slider),
      this.said,
      element("label", {}, this.hasBoxes, " Boxes"),
      element("label", {}, "Triangles ", this.triangles)
    );
    const verdict = element("p", {}, badge(facts.state), facts.said);
    const head = element("figcaption", {}, element("h3", {}, facts.title), verdict);
    const box = element("div", {class: "canvas"}, this.canvas);
    this.element = element("figure", {class: "view"}, head, controls, box, this.legend());
    this.canvas.chart = this;
    seen.observe(this.canvas);
  }

  legend() {
    const entries = {
      contact: "intersects another triangle",
      pair: "its box overlaps another's",
      inner: "box of an inner node",
      leaf: "box of a leaf",
    };
    const named = ([key, text]) => element("span", {}, swatch({colour: SCENE[key], symbol: "square"}), text);
    return element("p", {class: "legend plain"}, ...Object.entries(entries).map(named));
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
    dark.addEventListener("change", () => this.paint());
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    this.show();
    this.resize();
    this.canvas.classList.add("drawn");
  }

  async fill() {
    const arrayOf = async ([name, Type]) => new Type(await blobOf(`view-${this.number}-${name}`).arrayBuffer());
    const arrays = {points: Float32Array, boxes: Float32Array, faces: Uint32Array, pairs: Uint32Array, contacts: Uint32Array};
    const [points, boxes, faces, ...found] = await Promise.all(Object.entries(arrays).map(arrayOf));
    const [inPair, inContact] = found.map((pairs) => new Set(pairs));
    const colours = Object.fromEntries(Object.entries(SCENE).map(([key, value]) => [key, new THREE.Color(value)]));
    const kindOf = (triangle) => (inContact.has(triangle) ? "contact" : inPair.has(triangle) ? "pair" : "plain");
    const material = new THREE.MeshLambertMaterial({
      vertexColors: THREE.VertexColors,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.boxes = boxes;
    this.mesh = new THREE.Mesh(trianglesGeometry(points, faces, (triangle) => colours[kindOf(triangle)]), material);
    const colliding = Uint32Array.from(faces.keys()).filter((corner) => kindOf(Math.floor(corner / 3)) !== "plain");
    this.colliding = new THREE.BufferAttribute(colliding, 1);
    this.lines = ["inner", "leaf"].map(
      (kind) => new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: SCENE[kind]}))
    );
    this.camera = this.placedCamera();
    this.scene = new THREE.Scene();
    this.scene.add(this.camera, new THREE.AmbientLight("#ffffff", 0.55), this.mesh, ...this.lines);
    this.paint();
  }

  /** Gives the scene the page's background. */
  paint() {
    this.scene.background = new THREE.Color(colour("card"));
    this.render();
  }

  /** Returns a camera with a lamp, from where the whole scene is visible, whatever its size, and that the reader moves. */
  placedCamera() {
    this.mesh.geometry.computeBoundingSphere();
    const {center, radius} = this.mesh.geometry.boundingSphere;
    const size = radius || 1;
    const {clientWidth, clientHeight} = this.canvas.parentElement;
    const distance = (DISTANCE * size) / Math.min(1, clientWidth / clientHeight);
    const camera = new THREE.PerspectiveCamera(FIELD, 1, size / 100, size * 100);
    camera.position.copy(center).add(new THREE.Vector3(...SEEN_FROM).setLength(distance));
    const lamp = new THREE.DirectionalLight("#ffffff", 0.6);
    lamp.position.set(0.5, 1, 0.8);
    camera.add(lamp);
    const controls = new THREE.OrbitControls(camera, this.canvas);
    controls.target.copy(center);
    controls.update();
    controls.addEventListener("change", () => this.render());
    return camera;
  }

  /** Shows what the controls choose. */
  show() {
    const chosen = Number(this.slider.value);
    const {levels} = this.facts;
    const level = levels[chosen] || {count: 0, leaves: 0};
    const boxes = plural(level.count, "box").replace("boxs", "boxes");
    this.said.textContent = levels.length
      ? `${chosen} of ${levels.length - 1}: ${boxes}, ${counted(level.leaves)} of leaves`
      : "no boxes: the tree is wrong";
    if (!this.scene) {
      return;
    }
    const first = levels.slice(0, chosen).reduce((sum, one) => sum + one.count, 0);
    const leaves = first + level.count - level.leaves;
    [[first, leaves], [leaves, first + level.count]].forEach(([from, to], k) => {
      this.lines[k].geometry.dispose();
      this.lines[k].geometry = boxesGeometry(this.boxes, from, to);
      this.lines[k].visible = this.hasBoxes.checked;
    });
    this.mesh.visible = this.triangles.value !== "none";
    this.mesh.geometry.setIndex(this.triangles.value === "some" ? this.colliding : null);
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
