// Photovoltaic modules (gpu_shading modules): the field by loss of beam, and a string by day and hour.

const chosenModules = {field: 0, string: 0};

function lossText(loss) { return `${numberText(100 * loss, 1)} %`; }

function mostLoss(field) { return Math.max(...field.modules.map(([, , , loss]) => loss)); }

// The modules as seen from outside, the chosen string with a frame; onString(string): a click on a module.
function fieldPlot(field, chosen, onString) {
  const columns = Math.max(...field.modules.map(([, column]) => column));
  const rows = Math.max(...field.modules.map(([, , row]) => row));
  const size = Math.min(366 / (columns * field.width), 260 / (rows * field.height));
  const [width, height] = [size * field.width, size * field.height];
  const gap = Math.min(1, 0.1 * width, 0.1 * height);
  const most = mostLoss(field);
  const plot = svg("svg", {viewBox: `-2 -2 370 ${(rows * height + 4).toFixed(2)}`, role: "img",
    "aria-label": `Loss of beam of each module on ${field.surface}`});
  for (const [string, column, row, loss] of field.modules) {
    const box = svg("rect", {x: ((column - 1) * width + gap).toFixed(2), y: ((rows - row) * height + gap).toFixed(2),
      width: (width - 2 * gap).toFixed(2), height: (height - 2 * gap).toFixed(2),
      fill: css(scaleColour(most > 0 ? 1 - loss / most : 1)), class: string === chosen + 1 && field.strings.length > 1 ? "module now-string" : "module"});
    box.append(svg("title", {}, `String ${string}, column ${column}, row ${row}: ${lossText(loss)} of its beam is lost`));
    box.addEventListener("click", () => onString(string - 1));
    plot.append(box);
  }
  return plot;
}

function stringPlot(field, string) {
  const codes = bytesOf(field.strings[string]);
  const codeAt = (day, hour) => codes[24 * day + hour - 1];
  const days = content.modules.days.map(([month, day], d) => ({month, day, hours: Array.from({length: 24}, (_, i) => [i + 1])
    .filter(([hour]) => codeAt(d, hour) !== content.modules.dark)}));
  if (days.every((day) => day.hours.length === 0)) return svg("svg", {viewBox: "0 0 1 1"});
  const code = (d, h) => codeAt(d, days[d].hours[h][0]);
  return carpet(null, () => {}, {about: `Sunlit fraction of string ${string + 1} on ${field.surface} by day and hour`, days,
    value: (d, h) => code(d, h) / 100, text: (d, h) => `${code(d, h)} %`});
}

function showModules() {
  const field = content.modules.fields[chosenModules.field];
  const chooseString = (string) => {
    chosenModules.string = Math.min(string, field.strings.length - 1);
    showModules();
  };
  const strings = part("module-string");
  strings.replaceChildren(...field.strings.map((_, i) => new Option(`String ${i + 1}`, i)));
  strings.value = chosenModules.string;
  strings.onchange = () => chooseString(Number(strings.value));
  part("field-loss").textContent = lossText(mostLoss(field));
  part("field-plot").replaceChildren(fieldPlot(field, chosenModules.string, chooseString));
  part("string-plot").replaceChildren(...(field.strings.length > 0 ? [stringPlot(field, chosenModules.string)] : []));
  part("string-figure").hidden = field.strings.length === 0;
}

function addModules() {
  const {fields, days} = content.modules;
  part("modules").hidden = fields.length === 0;
  if (fields.length === 0) return;
  const text = ([month, day]) => dayText({month, day});
  part("module-days").textContent = days.length > 0 ? `${text(days[0])} to ${text(days[days.length - 1])}` : "no day";
  const surfaces = part("module-surface");
  surfaces.append(...fields.map((field, i) => new Option(field.surface, i)));
  surfaces.addEventListener("change", () => {
    Object.assign(chosenModules, {field: Number(surfaces.value), string: 0});
    showModules();
  });
  for (const plot of ["field", "string"]) {
    part(`save-${plot}`).addEventListener("click", () => saveChart(document.querySelector(`#${plot}-plot svg`),
      fields[chosenModules.field].surface));
  }
  showModules();
}
