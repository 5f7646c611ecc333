// The model in 3D. Called after every change: showHour, choose, lookFrom and so on; onChoose(receiver) is the user's click.

const VIEWS = {"south-east": [0.75, -1, 0.62], "south-west": [-0.75, -1, 0.62], "north-east": [0.75, 1, 0.62],
  "north-west": [-0.75, 1, 0.62], above: [0, -0.001, 1]};
const MOST_EDGES = 80000;
// Radii of the sun's path and of the ground, in radii of the receivers.
const PATH = 1.4;
const GROUND = 1.6;

function canDrawModel() {
  if (typeof THREE === "undefined") return false;
  const context = document.createElement("canvas").getContext("webgl");
  if (context) context.getExtension("WEBGL_lose_context")?.loseContext();
  return Boolean(context);
}

// Triangles of many surfaces in one mesh, with the number of the surface of each.
class Merged {
  constructor(surfaces, numbers, middle, repeat) {
    this.middle = middle;
    this.repeat = repeat;
    this.owners = []; // by triangle
    this.ranges = new Map(); // of vertices, by surface: [first, end]
    let end = 0;
    for (const number of numbers) {
      const {rings} = surfaces[number];
      if (rings.length === 0) continue;
      const first = end;
      end += trianglePointsIn(rings);
      this.ranges.set(number, [first, end]);
      for (let i = first; i < end; i += 3) this.owners.push(number);
    }
    this.geometry = new THREE.BufferGeometry();
    const add = (name, size) => this.geometry.setAttribute(name, new THREE.Float32BufferAttribute(new Float32Array(end * size), size));
    add("position", 3);
    add("normal", 3);
    if (repeat) add("uv", 2);
    add("tint", 4);
    this.tint = this.geometry.attributes.tint;
    for (const number of this.ranges.keys()) this.place(number, surfaces[number].rings);
  }

  // Puts a surface, if it is one of these, where its rings are.
  place(number, rings) {
    const [first, end] = this.ranges.get(number) || [0, 0];
    if (first === end) return;
    const {position, normal: facing, uv} = this.geometry.attributes;
    const normal = normalOf(rings[0]);
    const {u, v} = axesOf(normal);
    const points = trianglesOf(rings, normal);
    for (let i = first; i < end; ++i) {
      const point = points[i - first] || rings[0][0]; // there are fewer triangles where points are in one line
      position.setXYZ(i, ...point.map((value, axis) => value - this.middle[axis]));
      facing.setXYZ(i, ...normal);
      if (uv) uv.setXY(i, dot(point, u) / this.repeat, dot(point, v) / this.repeat);
    }
    for (const attribute of [position, facing, uv]) if (attribute) attribute.needsUpdate = true;
    this.geometry.boundingSphere = null;
  }

  // Red, green, blue, 0 .. 255; `tilts`: how much a surface's tilt may change it, or AS_IT_IS.
  paint(number, colour, tilts) {
    const [first, end] = this.ranges.get(number) || [0, 0];
    for (let i = first; i < end; ++i) {
      this.tint.setXYZW(i, colour[0] / 255, colour[1] / 255, colour[2] / 255, tilts);
    }
    this.tint.needsUpdate = true;
  }
}

// Edges of many surfaces, of the first ones if there are more than MOST_EDGES.
class EdgeLines {
  constructor(surfaces, numbers, middle) {
    this.middle = middle;
    this.firsts = new Map(); // vertices, by surface
    let end = 0;
    for (const number of numbers) {
      this.firsts.set(number, end);
      for (const ring of surfaces[number].rings) end += 2 * ring.length;
      if (end > 2 * MOST_EDGES) break;
    }
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.Float32BufferAttribute(new Float32Array(3 * end), 3));
    for (const number of this.firsts.keys()) this.place(number, surfaces[number].rings);
  }

  place(number, rings) {
    let at = this.firsts.get(number);
    if (at === undefined) return;
    const {position} = this.geometry.attributes;
    for (const ring of rings) {
      ring.forEach((point, i) => {
        for (const end of [point, ring[(i + 1) % ring.length]]) {
          position.setXYZ(at++, ...end.map((value, axis) => value - this.middle[axis]));
        }
      });
    }
    position.needsUpdate = true;
    this.geometry.boundingSphere = null;
  }
}

// Crowns beside receivers: the camera must not stand in one.
function crownsNear(receivers, surfaces) {
  const {middle, radius} = boundsOf(receivers);
  return surfaces.filter(({style, rings}) => content.styles[style].kind === "foliage"
    && Math.hypot(...rings[0][0].map((value, axis) => value - middle[axis])) < 4 * radius);
}

class ModelView {
  constructor(canvas, surfaces) {
    this.canvas = canvas;
    this.surfaces = surfaces;
    this.onChoose = () => {};
    const receivers = surfaces.slice(0, content.receiverCount);
    this.bounds = boundsOf(receivers.length ? [...receivers, ...crownsNear(receivers, surfaces)] : surfaces);
    this.radius = this.bounds.radius;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.renderer.setClearColor(0, 0);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.scene = new THREE.Scene();
    this.material = surfaceMaterial();
    this.casters = new THREE.Group();
    this.edges = new THREE.LineBasicMaterial({transparent: true, opacity: 0.55});
    // Of thousands of surfaces, edges would cover the surfaces.
    this.casterEdges = new THREE.LineBasicMaterial({transparent: true, opacity: surfaces.length > 5000 ? 0.12 : 0.55});
    this.sky = new THREE.Group();
    this.choiceLines = new THREE.Group();
    this.maps = new THREE.Group();
    this.placed = []; // Merged and EdgeLines
    this.scene.add(this.casters, this.maps, this.sky, this.choiceLines);
    this.addLight();
    this.addSurfaces();
    this.addGround();
    this.addCamera();
    this.pathShown = true;
    this.refreshTheme();
  }

  numbersOf(kind) {
    return this.surfaces.map((_, i) => i).filter((i) => content.styles[this.surfaces[i].style].kind === kind);
  }

  // The distance of the farthest surface, if it is not too far away for its shadow to count.
  reach() {
    const {middle} = this.bounds;
    let farthest = 0;
    for (const {rings} of this.surfaces) {
      for (const point of rings[0] || []) {
        farthest = Math.max(farthest, Math.hypot(...point.map((value, axis) => value - middle[axis])));
      }
    }
    return Math.min(1.05 * farthest, 4 * this.radius);
  }

  addLight() {
    this.light = new THREE.DirectionalLight(0xffffff, 1);
    this.light.castShadow = true;
    this.lightReach = this.reach();
    const reach = this.lightReach;
    const size = Math.min(reach > 30 ? 4096 : 2048, this.renderer.capabilities.maxTextureSize);
    const {shadow} = this.light;
    shadow.mapSize.set(size, size);
    Object.assign(shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 6 * reach});
    shadow.bias = -0.0003;
    this.material.uniforms.lift.value = Math.max(0.01, 3 * reach / size);
    this.scene.add(this.light, this.light.target);
  }

  addMesh(merged, material, group) {
    this.placed.push(merged);
    const mesh = new THREE.Mesh(merged.geometry, material);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.userData.owners = merged.owners;
    group.add(mesh);
    return mesh;
  }

  addSurfaces() {
    const {middle} = this.bounds;
    const receivers = this.numbersOf("receiver");
    const opaque = this.numbersOf("opaque");
    this.receivers = new Merged(this.surfaces, receivers, middle);
    this.opaque = new Merged(this.surfaces, opaque, middle);
    this.solid = [this.addMesh(this.receivers, this.material, this.scene),
      this.addMesh(this.opaque, this.material, this.casters)];
    this.scene.add(this.edgesOf(receivers, this.edges));
    this.casters.add(this.edgesOf(opaque, this.casterEdges));
    this.sheets = [];
    content.styles.forEach((style, number) => {
      if (["glass", "screen", "foliage"].includes(style.kind)) this.addSheets(style, number);
    });
  }

  addSheets(style, number) {
    const those = this.surfaces.map((_, i) => i).filter((i) => this.surfaces[i].style === number);
    if (those.length === 0) return;
    const merged = new Merged(this.surfaces, those, this.bounds.middle, PATTERN_REPEAT);
    const material = new THREE.MeshBasicMaterial({side: THREE.DoubleSide, transparent: true, depthWrite: false});
    if (style.kind === "screen") material.alphaMap = patternTexture(style);
    const mesh = this.addMesh(merged, material, this.casters);
    mesh.renderOrder = 1;
    this.sheets.push({style, material, mesh, rasters: new Map()});
    if (style.kind !== "foliage") this.casters.add(this.edgesOf(those, this.casterEdges));
  }

  // Draws what changes with time as it is now, with a raster for each of the steps of its shadow.
  deploySheets() {
    for (const {style, material, mesh, rasters} of this.sheets) {
      const passes = passesNow(style, this.time);
      material.opacity = opacityNow(style, this.time);
      mesh.castShadow = passes < 0.97;
      const step = Math.round(32 * passes);
      if (!rasters.has(step)) {
        const now = {...style, passes, ...style.kind !== "screen" && {hole: "texture", arrangement: ""}};
        const raster = patternTexture(now);
        raster.generateMipmaps = false;
        raster.minFilter = raster.magFilter = THREE.NearestFilter;
        rasters.set(step, depthMaterial(raster));
      }
      mesh.customDepthMaterial = rasters.get(step);
      material.color.setHex(theme()[style.kind]);
      if (style.kind === "foliage") material.color.lerp(new THREE.Color(theme().wood), 1 - shareNow(style, this.time));
    }
  }

  edgesOf(numbers, material) {
    const lines = new EdgeLines(this.surfaces, numbers, this.bounds.middle);
    this.placed.push(lines);
    return new THREE.LineSegments(lines.geometry, material);
  }

  // A disc below everything, and the terrain, where it may be lower.
  addGround() {
    this.floor = this.bounds.low[2] - this.bounds.middle[2] - 0.002 * this.radius;
    const disc = new THREE.CircleBufferGeometry((content.terrain ? 1.05 : GROUND) * this.radius, 128);
    disc.setAttribute("tint", new THREE.Float32BufferAttribute(new Float32Array(disc.attributes.position.count * 4), 4));
    const ground = new THREE.Mesh(disc, this.material);
    ground.position.z = this.floor;
    ground.receiveShadow = true;
    this.scene.add(ground);
    this.groundTints = [[disc.attributes.tint, 0]];
    if (!content.terrain) return;
    const terrain = new THREE.Mesh(terrainGeometry(content.terrain, this.bounds.middle), this.material);
    terrain.castShadow = terrain.receiveShadow = true;
    this.casters.add(terrain);
    this.groundTints.push([terrain.geometry.attributes.tint, 1]);
  }

  addCamera() {
    this.camera = new THREE.PerspectiveCamera(32, 1, this.radius / 50, this.radius * 30);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.minDistance = 0.2 * this.radius;
    this.controls.maxDistance = 12 * this.radius;
    this.controls.maxPolarAngle = 0.54 * Math.PI;
    this.controls.addEventListener("change", () => this.draw());
    this.lookFrom("south-east");
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.resize();
    this.canvas.addEventListener("keydown", (event) => this.press(event));
    let pressed = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
    this.canvas.addEventListener("click", (event) => {
      if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 5) this.pick(event);
    });
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // `from`: a key of VIEWS, or "sun"; by default, the last one.
  lookFrom(from = this.from) {
    this.from = from;
    const direction = from === "sun" && this.sun ? this.sun : VIEWS[from] || VIEWS["south-east"];
    const narrow = Math.min(1, this.camera.aspect);
    const distance = 4.8 * this.radius / Math.max(narrow, 0.55);
    this.controls.target.set(0, 0, 0.15 * this.radius);
    this.camera.position.set(...unit(direction).map((value) => distance * value)).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  press(event) {
    const turns = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
    const zooms = {"+": 0.9, "=": 0.9, "-": 1 / 0.9};
    const offset = new THREE.Vector3().subVectors(this.camera.position, this.controls.target);
    if (turns[event.key]) {
      offset.applyAxisAngle(new THREE.Vector3(0, 0, 1), turns[event.key][0]);
      const level = new THREE.Vector3().crossVectors(new THREE.Vector3(0, 0, 1), offset).normalize();
      offset.applyAxisAngle(level, turns[event.key][1]);
    } else if (zooms[event.key]) {
      offset.multiplyScalar(zooms[event.key]);
    } else if (event.key === "0") {
      this.lookFrom();
      return;
    } else {
      return;
    }
    event.preventDefault();
    this.camera.position.addVectors(this.controls.target, offset);
    this.controls.update();
    this.draw();
  }

  pick(event) {
    const number = this.numberAt(event);
    if (number < content.receiverCount) this.onChoose(number);
  }

  // Of the surface under the pointer, if there is one.
  numberAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1,
      1 - 2 * (event.clientY - box.top) / box.height);
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, this.camera);
    const meshes = this.casters.visible ? this.solid : this.solid.slice(0, 1);
    const [hit] = caster.intersectObjects(meshes);
    return hit && hit.object.userData.owners[hit.faceIndex];
  }

  showHour(day, hour) {
    this.time = [day, hour];
    const moved = moveSurfaces(this.surfaces, day, hour);
    for (const number of moved) for (const one of this.placed) one.place(number, this.surfaces[number].rings);
    if (moved.includes(this.chosen)) this.choose(this.chosen);
    const direction = content.days[day].hours[hour];
    this.sun = sunDirection(direction);
    this.light.position.set(...this.sun).multiplyScalar(3 * this.lightReach);
    this.material.uniforms.sun.value.set(...this.sun);
    this.deploySheets();
    this.paint();
    this.drawSky();
    this.draw();
  }

  paint() {
    for (let i = 0; i < content.receiverCount; ++i) {
      if (this.mapKind) {
        this.receivers.paint(i, theme().caster, 1);
        continue;
      }
      const percent = this.time ? percentOf(i, ...this.time) : content.turnedAway;
      this.receivers.paint(i, percentColour(percent), percent === content.turnedAway ? AS_IT_IS : 0.3);
    }
  }

  drawSky() {
    this.sky.children.slice().forEach((child) => this.sky.remove(child));
    const ring = horizon(PATH * this.radius, theme());
    ring.position.z = this.floor + 0.004 * this.radius;
    this.sky.add(ring);
    if (!this.time || !this.pathShown) return;
    const path = sunPath(...this.time, PATH * this.radius);
    path.position.z = this.floor;
    this.sky.add(path);
  }

  choose(receiver) {
    this.choiceLines.children.slice().forEach((child) => this.choiceLines.remove(child));
    this.chosen = receiver;
    if (receiver === undefined) return;
    const material = new THREE.MeshBasicMaterial({color: theme().choice, depthTest: false, transparent: true,
      side: THREE.DoubleSide});
    const mesh = new THREE.Mesh(this.ribbon(this.surfaces[receiver].rings), material);
    mesh.renderOrder = 2;
    this.choiceLines.add(mesh);
    this.draw();
  }

  // A strip along each edge: lines are one pixel wide.
  ribbon(rings) {
    const {middle} = this.bounds;
    const places = [];
    const half = 0.006 * this.radius;
    const normal = rings.length ? normalOf(rings[0]) : [0, 0, 1];
    for (const ring of rings) {
      ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        const along = b.map((value, axis) => value - a[axis]);
        if (Math.hypot(...along) === 0) return;
        const across = cross(normal, unit(along)).map((value) => half * value);
        const corner = (point, sign) => point.map((value, axis) => value - middle[axis] + sign * across[axis]);
        const [p, q, r, s] = [corner(a, -1), corner(b, -1), corner(b, 1), corner(a, 1)];
        places.push(...p, ...q, ...r, ...p, ...r, ...s);
      });
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
    return geometry;
  }

  // A key of MAP_KINDS, or "" for the sunlit fraction.
  colourBy(kind) {
    this.mapKind = kind;
    this.maps.children.slice().forEach((child) => this.maps.remove(child));
    for (const map of kind ? content.maps.list : []) {
      this.maps.add(mapMesh(map, kind, this.surfaces[map.receiver], this.bounds.middle));
    }
    this.paint();
    this.draw();
  }

  setCasters(shown) {
    this.casters.visible = shown;
    this.draw();
  }

  setPath(shown) {
    this.pathShown = shown;
    this.drawSky();
    this.draw();
  }

  refreshTheme() {
    const {caster, ground, edge} = theme();
    for (const number of this.numbersOf("opaque")) this.opaque.paint(number, caster, 1);
    for (const [tint, tilts] of this.groundTints) {
      for (let i = 0; i < tint.count; ++i) tint.setXYZW(i, ground[0] / 255, ground[1] / 255, ground[2] / 255, tilts);
      tint.needsUpdate = true;
    }
    this.edges.color.setHex(edge);
    this.casterEdges.color.setHex(edge);
    this.deploySheets();
    this.paint();
    this.drawSky();
    this.choose(this.chosen);
    this.draw();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.waiting = false;
    this.material.uniforms.shadows.value = this.time ? 1 : 0;
    this.renderer.render(this.scene, this.camera);
  }

  // A picture of the size of another canvas.
  copyTo(canvas) {
    const {width, height} = canvas;
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.drawNow();
    const context = canvas.getContext("2d");
    context.clearRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    this.resize();
  }
}
