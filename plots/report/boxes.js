// SPDX-License-Identifier: MIT
// Geometry of a scene for three.js: triangles with a colour each, and the twelve edges of each box.
const EDGES = [0, 1, 1, 3, 3, 2, 2, 0, 4, 5, 5, 7, 7, 6, 6, 4, 0, 4, 1, 5, 2, 6, 3, 7]; // corners by bits: x 1, y 2, z 4

/** Three corners a triangle, none shared, so that each has a normal and a colour of its own. */
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

/** Boxes first to before end, six sides each: min x, y, z, max x, y, z. */
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

/** Which triangles are in a pair: 1 for each that is. */
function marks(pairs, count) {
  const found = new Uint8Array(count);
  pairs.forEach((triangle) => {
    found[triangle] = 1;
  });
  return found;
}
