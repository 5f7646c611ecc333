// The sun: its direction, its path over the model, and north.

// To the sun, from degrees: x east, y north, z up.
function sunDirection([, azimuth, altitude]) {
  const a = azimuth * Math.PI / 180;
  const h = altitude * Math.PI / 180;
  return [Math.sin(a) * Math.cos(h), Math.cos(a) * Math.cos(h), Math.sin(h)];
}

// As large at any distance; `height` of the picture's.
function textSprite(text, colour, height) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const context = canvas.getContext("2d");
  context.font = "bold 88px sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  // A halo, because it may be before anything.
  context.strokeStyle = theme().halo;
  context.lineWidth = 16;
  context.lineJoin = "round";
  context.strokeText(text, 64, 68);
  context.fillStyle = colour;
  context.fillText(text, 64, 68);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false,
    sizeAttenuation: false}));
  sprite.scale.set(height, height, 1);
  sprite.renderOrder = 3;
  return sprite;
}

// The horizon on the ground, with the points of the compass and an arrow to the north.
function horizon(radius, {north, horizon: colour, text}) {
  const group = new THREE.Group();
  const ring = new THREE.EllipseCurve(0, 0, radius, radius).getPoints(128);
  group.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(ring), new THREE.LineBasicMaterial({color: colour})));
  const arrow = new THREE.Shape();
  [[0, 1.0], [0.05, 0.86], [0, 0.89], [-0.05, 0.86]].forEach(([x, y], i) =>
    i === 0 ? arrow.moveTo(radius * x, radius * y) : arrow.lineTo(radius * x, radius * y));
  group.add(new THREE.Mesh(new THREE.ShapeBufferGeometry(arrow),
    new THREE.MeshBasicMaterial({color: north, side: THREE.DoubleSide})));
  for (const [letter, x, y] of [["N", 0, 1], ["E", 1, 0], ["S", 0, -1], ["W", -1, 0]]) {
    const sprite = textSprite(letter, letter === "N" ? north : text, letter === "N" ? 0.034 : 0.026);
    sprite.position.set(1.09 * radius * x, 1.09 * radius * y, 0);
    group.add(sprite);
  }
  return group;
}

function pathLine(day, radius, colour, opacity) {
  const points = day.hours.map((hour) => new THREE.Vector3(...sunDirection(hour)).multiplyScalar(radius));
  // Through the hours, smoothly.
  const smooth = points.length > 2 ? new THREE.CatmullRomCurve3(points).getPoints(8 * points.length) : points;
  return new THREE.Line(new THREE.BufferGeometry().setFromPoints(smooth),
    new THREE.LineBasicMaterial({color: colour, transparent: opacity < 1, opacity}));
}

// The paths of the lowest and the highest day, faint, and of this one, with a dot for each hour and the sun.
function sunPath(dayNumber, hourNumber, radius) {
  const group = new THREE.Group();
  const {path, text} = theme();
  const noon = (day) => Math.max(0, ...day.hours.map((hour) => hour[2]));
  const byNoon = content.days.filter((day) => day.hours.length > 2).sort((a, b) => noon(a) - noon(b));
  for (const day of new Set([byNoon[0], byNoon[byNoon.length - 1]])) {
    if (day) group.add(pathLine(day, radius, path, 0.35));
  }
  const day = content.days[dayNumber];
  group.add(pathLine(day, radius, path, 1));
  const dots = new THREE.BufferGeometry().setFromPoints(
    day.hours.map((hour) => new THREE.Vector3(...sunDirection(hour)).multiplyScalar(radius)));
  group.add(new THREE.Points(dots, new THREE.PointsMaterial({color: path, size: 5, sizeAttenuation: false})));
  day.hours.forEach((hour, i) => {
    if (hour[0] % 3 !== 0 || i === hourNumber) return;
    const label = textSprite(String(hour[0]), text, 0.026);
    label.position.set(...sunDirection(hour).map((value) => 1.07 * radius * value));
    group.add(label);
  });
  const sun = new THREE.Mesh(new THREE.SphereBufferGeometry(0.045 * radius, 24, 16),
    new THREE.MeshBasicMaterial({color: 0xffb000}));
  sun.position.set(...sunDirection(day.hours[hourNumber]).map((value) => radius * value));
  group.add(sun);
  return group;
}
