// The model where there is no WebGL or no library for it: surfaces from the farthest to the nearest, without shadows.

class PlainDrawing {
  constructor(canvas, surfaces) {
    this.canvas = canvas;
    this.all = surfaces;
    this.surfaces = surfaces.filter((surface) => surface.rings.length > 0);
    this.numbers = surfaces.map((_, i) => i).filter((i) => surfaces[i].rings.length > 0);
    this.onChoose = () => {};
    this.direction = [0.75, -1, 0.62];
    this.castersShown = true;
    this.maps = new Map(); // by receiver: {map, picture}
    canvas.addEventListener("click", (event) => this.pick(event));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  lookFrom(from) {
    this.direction = {"south-east": [0.75, -1, 0.62], "south-west": [-0.75, -1, 0.62], "north-east": [0.75, 1, 0.62],
      "north-west": [-0.75, 1, 0.62], above: [0, -0.001, 1],
      sun: this.time ? sunDirection(content.days[this.time[0]].hours[this.time[1]]) : [0, 0, 1]}[from];
    this.draw();
  }
  showHour(day, hour) {
    this.time = [day, hour];
    moveSurfaces(this.all, day, hour);
    this.draw();
  }
  choose(receiver) { this.chosen = receiver; this.draw(); }
  setCasters(shown) { this.castersShown = shown; this.draw(); }
  setPath() {}
  colourBy(kind) {
    this.mapKind = kind;
    this.maps = new Map((kind ? content.maps.list : []).map((map) => [map.receiver, {map, picture: mapCanvas(map, kind)}]));
    this.draw();
  }
  copyTo(canvas) {
    canvas.height = canvas.width * this.canvas.height / this.canvas.width;
    canvas.getContext("2d").drawImage(this.canvas, 0, 0, canvas.width, canvas.height);
  }
  refreshTheme() { this.draw(); }

  colourOf(number) {
    if (number >= content.receiverCount || this.mapKind) return theme().caster;
    return this.time ? percentColour(percentOf(number, ...this.time)) : theme().turnedAway;
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    this.canvas.width = width * devicePixelRatio;
    this.canvas.height = height * devicePixelRatio;
    const towards = unit(this.direction);
    const right = unit(cross([0, 0, 1], towards));
    const up = cross(towards, right);
    const {middle, radius} = boundsOf(this.surfaces.slice(0, Math.max(content.receiverCount, 1)));
    const scale = Math.min(this.canvas.width, this.canvas.height) / (2.1 * radius);
    const place = (point) => {
      const from = point.map((value, axis) => value - middle[axis]);
      return [this.canvas.width / 2 + scale * dot(from, right), this.canvas.height / 2 - scale * dot(from, up)];
    };
    const depth = ({rings}) => rings[0].reduce((sum, point) => sum + dot(point, towards), 0) / rings[0].length;
    this.drawn = this.surfaces.map((surface, i) => ({...surface, number: this.numbers[i], depth: depth(surface)}))
      .filter(({number, rings}) => number < content.receiverCount ? dot(normalOf(rings[0]), towards) > 0 : this.castersShown)
      .sort((a, b) => a.depth - b.depth);
    const context = this.canvas.getContext("2d");
    for (const one of this.drawn) {
      one.path = new Path2D();
      for (const ring of one.rings) {
        ring.forEach((point, i) => one.path[i === 0 ? "moveTo" : "lineTo"](...place(point)));
        one.path.closePath();
      }
      const style = content.styles[one.style];
      context.globalAlpha = ["glass", "foliage", "screen"].includes(style.kind) ? opacityNow(style, this.time) : 1;
      context.fillStyle = css(this.colourOf(one.number));
      context.strokeStyle = one.number === this.chosen ? `#${theme().choice.toString(16).padStart(6, "0")}` : "#30353b";
      context.lineWidth = one.number === this.chosen ? 3 : 1;
      context.fill(one.path, "evenodd");
      if (this.maps.has(one.number)) this.drape(one.path, this.maps.get(one.number), place);
      context.stroke(one.path);
    }
    context.globalAlpha = 1;
    this.drawNorth(right, up);
  }

  // An arrow to the north in the lower right corner.
  drawNorth(right, up) {
    const context = this.canvas.getContext("2d");
    const length = 34 * devicePixelRatio;
    const [x, y] = [this.canvas.width - 1.6 * length, this.canvas.height - 1.6 * length];
    const [dx, dy] = [right[1], -up[1]];
    const place = (along, across) => [x + length * (along * dx - across * dy), y + length * (along * dy + across * dx)];
    context.fillStyle = context.strokeStyle = theme().north;
    context.lineWidth = 2 * devicePixelRatio;
    context.beginPath();
    context.moveTo(...place(-0.7, 0));
    context.lineTo(...place(0.4, 0));
    context.stroke();
    context.beginPath();
    for (const corner of [[0.8, 0], [0.35, 0.18], [0.35, -0.18]]) context.lineTo(...place(...corner));
    context.fill();
    context.font = `bold ${15 * devicePixelRatio}px sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText("N", ...place(1.25, 0));
  }

  // In parallel projection, the rectangle of a map is a parallelogram. `place`: of a point on the canvas.
  drape(path, {map, picture}, place) {
    const context = this.canvas.getContext("2d");
    const [x, y] = place(map.corner);
    const along = (side) => place(map.corner.map((value, axis) => value + side[axis]));
    const [rightX, rightY] = along(map.right);
    const [upX, upY] = along(map.up);
    context.save();
    context.clip(path, "evenodd");
    context.imageSmoothingEnabled = false;
    context.setTransform((rightX - x) / map.columns, (rightY - y) / map.columns, (upX - x) / map.rows, (upY - y) / map.rows,
      x, y);
    context.drawImage(picture, 0, 0);
    context.restore();
  }

  pick(event) {
    const number = this.numberAt(event);
    if (number < content.receiverCount) this.onChoose(number);
  }

  numberAt(event) {
    const box = this.canvas.getBoundingClientRect();
    const context = this.canvas.getContext("2d");
    const x = (event.clientX - box.left) * devicePixelRatio;
    const y = (event.clientY - box.top) * devicePixelRatio;
    return (this.drawn || []).filter(({path}) => context.isPointInPath(path, x, y, "evenodd")).pop()?.number;
  }
}
