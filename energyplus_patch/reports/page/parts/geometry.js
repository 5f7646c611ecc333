// Surfaces as rings of points and as triangles, in metres about the middle of the receivers.

// [{style, rings: [[x, y, z], ...]}, ...], in the content's order.
function readSurfaces() {
  const {low, step, shape, places} = content.geometry;
  const counts = shortsOf(shape);
  const steps = shortsOf(places);
  const surfaces = [];
  let place = 0;
  for (let at = 0; at < counts.length;) {
    const surface = {style: counts[at++], rings: []};
    for (let rings = counts[at++]; rings > 0; --rings) {
      const ring = [];
      for (let left = counts[at++]; left > 0; --left, place += 3) {
        ring.push([0, 1, 2].map((axis) => low[axis] + step * steps[place + axis]));
      }
      surface.rings.push(ring);
    }
    surfaces.push(surface);
  }
  return surfaces;
}

// Adds to each motion, by its surfaces and positions, their rings.
function readMotions(surfaces) {
  const {low, step} = content.geometry;
  for (const motion of content.motions) {
    motion.hours = shortsOf(motion.hours);
    const steps = shortsOf(motion.places);
    let place = -3;
    const readRing = (ring) => ring.map(() => {
      place += 3;
      return [0, 1, 2].map((axis) => low[axis] + step * steps[place + axis]);
    });
    motion.rings = motion.surfaces.map((number) => motion.positions.map(() => surfaces[number].rings.map(readRing)));
  }
}

function positionAt(motion, day, hour) { return motion.hours[content.firstHours[day] + hour]; }

// Moves surfaces to where they stand at an hour; returns the numbers of those that were elsewhere.
function moveSurfaces(surfaces, day, hour) {
  return content.motions.flatMap((motion) => motion.surfaces.filter((number, i) => {
    const rings = motion.rings[i][positionAt(motion, day, hour)];
    const moves = surfaces[number].rings !== rings;
    surfaces[number].rings = rings;
    return moves;
  }));
}

// The box of some points: {middle, radius, low, high}.
function boundsOf(surfaces) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const surface of surfaces) {
    for (const point of surface.rings[0] || []) {
      for (let axis = 0; axis < 3; ++axis) {
        low[axis] = Math.min(low[axis], point[axis]);
        high[axis] = Math.max(high[axis], point[axis]);
      }
    }
  }
  if (low[0] > high[0]) return {middle: [0, 0, 0], radius: 1, low: [0, 0, 0], high: [0, 0, 0]};
  const middle = low.map((value, axis) => (value + high[axis]) / 2);
  return {middle, low, high, radius: Math.max(Math.hypot(...high.map((value, axis) => value - low[axis])) / 2, 0.1)};
}

// The unit normal of a ring, by Newell's method; up where there is none.
function normalOf(ring) {
  const normal = [0, 0, 0];
  ring.forEach((a, i) => {
    const b = ring[(i + 1) % ring.length];
    normal[0] += (a[1] - b[1]) * (a[2] + b[2]);
    normal[1] += (a[2] - b[2]) * (a[0] + b[0]);
    normal[2] += (a[0] - b[0]) * (a[1] + b[1]);
  });
  const length = Math.hypot(...normal);
  return length > 0 ? normal.map((value) => value / length) : [0, 0, 1];
}

function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function unit(a) { const length = Math.hypot(...a); return a.map((value) => value / length); }

// Axes in a surface's plane: u level, to the right as seen from outside, v up the slope.
function axesOf(normal) {
  const level = [-normal[1], normal[0], 0];
  const u = Math.hypot(...level) > 1e-6 ? unit(level) : [1, 0, 0];
  return {u, v: cross(normal, u)};
}

// How many points of triangles a surface has, unless some are in one line.
function trianglePointsIn(rings) {
  return 3 * (rings.reduce((sum, ring) => sum + ring.length + 2, 0) - 4);
}

// Points of triangles, three by three.
function trianglesOf(rings, normal) {
  const outline = rings[0];
  if (rings.length === 1 && outline.length === 3) return outline;
  const {u, v} = axesOf(normal);
  const flat = (ring) => ring.map((point) => new THREE.Vector2(dot(point, u), dot(point, v)));
  const all = rings.flat();
  return THREE.ShapeUtils.triangulateShape(flat(outline), rings.slice(1).map(flat)).flatMap((triangle) =>
    triangle.map((i) => all[i]));
}
