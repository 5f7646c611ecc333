// Maps of sun hours and beam energy (gpu_shading map) on the receivers that have one.

// What receivers may be coloured by: [value of the option, what it says, unit, index among the means].
const MAP_KINDS = [["hours", "Sunlit hours", "h", 0], ["energy", "Beam energy", "kWh/m\u00b2", 1]];

function mapDays() {
  const text = (day) => `${Number(day.slice(3))} ${MONTHS[Number(day.slice(0, 2)) - 1].slice(0, 3)}`;
  return `${text(content.maps.from)} to ${text(content.maps.to)}`;
}

// Red, green, blue and opacity of each cell, from the lowest row up.
function mapTexels(map, kind) {
  const codes = bytesOf(map[kind]);
  const texels = new Uint8ClampedArray(4 * codes.length);
  codes.forEach((code, i) => texels.set(code === 255 ? [0, 0, 0, 0] : [...scaleColour(code / 250), 255], 4 * i));
  return texels;
}

function mapTexture(map, kind) {
  const texture = new THREE.DataTexture(new Uint8Array(mapTexels(map, kind)), map.columns, map.rows, THREE.RGBAFormat);
  texture.magFilter = texture.minFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

// A canvas with a pixel for each cell, the lowest row at the top.
function mapCanvas(map, kind) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [map.columns, map.rows];
  canvas.getContext("2d").putImageData(new ImageData(mapTexels(map, kind), map.columns, map.rows), 0, 0);
  return canvas;
}

// The receiver's surface with its map on it.
function mapMesh(map, kind, surface, middle) {
  const places = [];
  const textured = [];
  const along = (point, axis) => dot(point.map((value, i) => value - map.corner[i]), axis) / dot(axis, axis);
  for (const point of trianglesOf(surface.rings, normalOf(surface.rings[0]))) {
    places.push(...point.map((value, axis) => value - middle[axis]));
    textured.push(along(point, map.right), along(point, map.up));
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute("uv", new THREE.Float32BufferAttribute(textured, 2));
  return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({map: mapTexture(map, kind), side: THREE.DoubleSide,
    transparent: true, alphaTest: 0.5}));
}
