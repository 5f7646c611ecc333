// Saves pictures of the model and of charts, and the day as an animation.

function saveAs(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function fileStem() { return document.title.replace(/[^\w.-]+/g, "_"); }

function savePicture(canvas) {
  view.drawNow?.();
  canvas.toBlob((blob) => saveAs(`${fileStem()}.png`, blob));
}

// With the colours of the page's style sheet in it.
function chartText(plot) {
  const copy = plot.cloneNode(true);
  const all = [plot, ...plot.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((element, i) => {
    const style = getComputedStyle(all[i]);
    for (const key of ["fill", "stroke", "stroke-width", "font-size", "font-family"]) {
      element.style.setProperty(key, style.getPropertyValue(key));
    }
    if (style.fill.includes("#") && style.fill.includes("url")) element.setAttribute("fill", "none");
  });
  copy.setAttribute("xmlns", SVG);
  copy.style.background = getComputedStyle(document.documentElement).backgroundColor;
  return new XMLSerializer().serializeToString(copy);
}

function saveChart(plot, surface) {
  saveAs(`${fileStem()}_${surface.replace(/[^\w.-]+/g, "_")}.svg`,
    new Blob([chartText(plot)], {type: "image/svg+xml"}));
}

function canRecord() {
  return typeof MediaRecorder !== "undefined" && typeof HTMLCanvasElement.prototype.captureStream === "function";
}

// The hours of the day that is shown, half a second each, as WebM. Calls onEnd when it is saved.
function saveAnimation(canvas, onEnd) {
  const recorder = new MediaRecorder(canvas.captureStream(10));
  const parts = [];
  const before = state.hour;
  recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
  recorder.addEventListener("stop", () => {
    saveAs(`${fileStem()}.webm`, new Blob(parts, {type: recorder.mimeType}));
    go(state.day, before);
    onEnd();
  });
  recorder.start();
  const {hours} = content.days[state.day];
  let hour = 0;
  const next = () => {
    if (hour === hours.length) {
      recorder.stop();
      return;
    }
    go(state.day, hour++);
    setTimeout(next, 500);
  };
  next();
}
