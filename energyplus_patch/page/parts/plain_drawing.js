// The model where there is no WebGL or no library for it: surfaces from the farthest to the nearest, without shadows.

class PlainDrawing {
  constructor(canvas, surfaces) {
    this.canvas = canvas;
    this.surfaces = surfaces.filter((surface) => surface.rings.length > 0);
    this.numbers = surfaces.map((_, i) => i).filter((i) => surfaces[i].rings.length > 0);
    this.onChoose = () => {};
    this.direction = [0.75, -1, 0.62];
    this.castersShown = true;
    canvas.addEventListener("click", (event) => this.pick(event));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  lookFrom(from) {
    this.direction = {"south-east": [0.75, -1, 0.62], "south-west": [-0.75, -1, 0.62], "north-east": [0.75, 1, 0.62],
      "north-west": [-0.75, 1, 0.62], above: [0, -0.001, 1],
      sun: this.time ? sunDirection(content.days[this.time[0]].hours[this.time[1]]) : [0, 0, 1]}[from];
    this.draw();
  }
  showHour(day, hour) { this.time = [day, hour]; this.draw(); }
  choose(receiver) { this.chosen = receiver; this.draw(); }
  setCasters(shown) { this.castersShown = shown; this.draw(); }
  setPath() {}
  copyTo(canvas) {
    canvas.height = canvas.width * this.canvas.height / this.canvas.width;
    canvas.getContext("2d").drawImage(this.canvas, 0, 0, canvas.width, canvas.height);
  }
  refreshTheme() { this.draw(); }

  colourOf(number) {
    if (number >= content.receiverCount) return theme().caster;
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
      context.globalAlpha = content.styles[one.style].kind === "glass" ? 0.4 : 1;
      context.fillStyle = css(this.colourOf(one.number));
      context.strokeStyle = one.number === this.chosen ? `#${theme().choice.toString(16).padStart(6, "0")}` : "#30353b";
      context.lineWidth = one.number === this.chosen ? 3 : 1;
      context.fill(one.path, "evenodd");
      context.stroke(one.path);
    }
  }

  pick(event) {
    const box = this.canvas.getBoundingClientRect();
    const context = this.canvas.getContext("2d");
    const x = (event.clientX - box.left) * devicePixelRatio;
    const y = (event.clientY - box.top) * devicePixelRatio;
    const hit = (this.drawn || []).filter(({path}) => context.isPointInPath(path, x, y, "evenodd")).pop();
    if (hit && hit.number < content.receiverCount) this.onChoose(hit.number);
  }
}
