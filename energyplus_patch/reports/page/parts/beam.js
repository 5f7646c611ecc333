// Light on a receiver: the beam by day and hour; the beam and the rest by month, and by hour of the months' mean days.

const WINDOW = 6;
const MONTHS_OF_LIGHT = 7;
const MEAN_DAYS = 8;
// As a receiver has them, if more than the beam is known.
const KINDS_OF_LIGHT = ["beam", "sky", "reflected by ground", "reflected by shades", "all light"];

// W per m2 of the receiver, with the mean beam of the days that the page's day stands for; null behind it.
function beamOf(receiver, day, hour) {
  const percent = percentOf(receiver, day, hour);
  if (percent === content.turnedAway) return null;
  const [, azimuth, tilt] = content.receivers[receiver];
  const sun = content.days[day].hours[hour];
  const normal = sunDirection([0, azimuth, 90 - tilt]);
  return Math.max(0, dot(sunDirection(sun), normal)) * sun[3] * percent / 100;
}

// In steps of 100 W/m2.
function mostBeam(receiver) {
  const beams = content.days.flatMap((day, d) => day.hours.map((_, h) => beamOf(receiver, d, h) || 0));
  return Math.max(100, 100 * Math.ceil(Math.max(...beams) / 100));
}

// The kinds of light, one on the other.
function monthBars(receiver) {
  const light = content.receivers[receiver][MONTHS_OF_LIGHT];
  const sums = light[light.length - 1];
  const layers = light.length > 1 ? light.slice(0, -1) : light;
  const most = Math.max(...sums, 0.1);
  const plot = svg("svg", {viewBox: "0 0 366 170", role: "img",
    "aria-label": `Light on ${content.names[receiver]} by month, kWh per m2`});
  sums.forEach((sum, i) => {
    const x = 8 + 29.5 * i;
    let y = 142;
    layers.forEach((months, layer) => {
      const height = 120 * months[i] / most;
      y -= height;
      const bar = svg("rect", {x, y, width: 22, height, class: `bar light-${layer}`});
      bar.append(svg("title", {}, `${MONTHS[i]}, ${KINDS_OF_LIGHT[layer]}: ${numberText(months[i], 1)} kWh/m\u00b2`));
      plot.append(bar);
    });
    plot.append(svg("text", {x: x + 11, y: y - 5, "text-anchor": "middle"}, numberText(sum, sum < 10 ? 1 : 0)),
      svg("text", {x: x + 11, y: 158, "text-anchor": "middle"}, MONTHS[i].slice(0, 3)));
  });
  plot.append(svg("path", {d: "M4 142H362", class: "axis"}));
  return plot;
}

// How many kinds the page has: one, or all.
function lightCount() { return content.receivers.length > 0 ? content.receivers[0][MONTHS_OF_LIGHT].length : 1; }

// A carpet of the mean days of the months, and the value of its yellow.
function meanDayCarpet(receiver, kind) {
  const values = shortsOf(content.receivers[receiver][MEAN_DAYS]);
  const at = (one, month, hour) => values[(12 * one + month - 1) * 24 + hour - 1];
  const hours = [...Array(24).keys()].map((hour) => hour + 1);
  const isLit = (month, hour) => at(lightCount() - 1, month, hour) > 0;
  const days = MONTHS.map((_, i) => ({month: i + 1, hours: hours.filter((hour) => isLit(i + 1, hour)).map((hour) => [hour])}))
    .filter((day) => day.hours.length > 0);
  const valueAt = (d, h) => at(kind, days[d].month, days[d].hours[h][0]);
  const most = Math.max(10, 10 * Math.ceil(Math.max(...days.flatMap((day, d) => day.hours.map((_, h) => valueAt(d, h)))) / 10));
  return [most, carpet(null, () => {}, {about: `Mean days of ${KINDS_OF_LIGHT[kind]} on ${content.names[receiver]}`, days,
    value: (d, h) => valueAt(d, h) / most, text: (d, h) => `${valueAt(d, h)} W/m\u00b2`})];
}
