// The ground near the model, from the heights of the nodes of a grid.

// Triangles with a normal each, `middle` at the origin; their tint is the ground's.
function terrainGeometry(terrain, middle) {
  const codes = shortsOf(terrain.heights);
  const places = [];
  const normals = [];
  const node = (column, row) => [terrain.low[0] + column * terrain.step[0], terrain.low[1] + row * terrain.step[1],
    terrain.low[2] + codes[row * terrain.nodes + column] * terrain.rise].map((value, axis) => value - middle[axis]);
  const add = (...corners) => {
    if (corners.some(([column, row]) => codes[row * terrain.nodes + column] === terrain.none)) return;
    const [a, b, c] = corners.map(([column, row]) => node(column, row));
    const normal = unit(cross(b.map((value, axis) => value - a[axis]), c.map((value, axis) => value - a[axis])));
    places.push(...a, ...b, ...c);
    normals.push(...normal, ...normal, ...normal);
  };
  for (let row = 0; row + 1 < terrain.nodes; ++row) {
    for (let column = 0; column + 1 < terrain.nodes; ++column) {
      add([column, row], [column + 1, row], [column + 1, row + 1]);
      add([column, row], [column + 1, row + 1], [column, row + 1]);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute("tint", new THREE.Float32BufferAttribute(new Float32Array(places.length / 3 * 4), 4));
  return geometry;
}
