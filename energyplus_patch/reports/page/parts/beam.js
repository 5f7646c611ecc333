// Beam solar energy on a receiver: by day and hour, and by month.

const WINDOW = 6;
const MONTH_BEAMS = 7;
const MONTH_REFLECTED = 8;

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

// Beam, and light reflected by the ground and by shades, one on the other.
function monthBars(receiver) {
  const months = content.receivers[receiver][MONTH_BEAMS];
  const layers = [["beam", months], ...content.receivers[receiver][MONTH_REFLECTED].map((light, i) =>
    [["reflected by the ground", "reflected by shades"][i], light])];
  const sums = months.map((_, i) => layers.reduce((sum, [, light]) => sum + light[i], 0));
  const most = Math.max(...sums, 0.1);
  const plot = svg("svg", {viewBox: "0 0 366 170", role: "img",
    "aria-label": `Beam energy on ${content.names[receiver]} by month, kWh per m2`});
  sums.forEach((sum, i) => {
    const x = 8 + 29.5 * i;
    let y = 142;
    layers.forEach(([name, light], layer) => {
      const height = 120 * light[i] / most;
      y -= height;
      const bar = svg("rect", {x, y, width: 22, height, class: `bar light-${layer}`});
      const what = layer > 0 ? `, ${name}` : "";
      bar.append(svg("title", {}, `${MONTHS[i]}${what}: ${numberText(light[i], 1)} kWh/m\u00b2`));
      plot.append(bar);
    });
    plot.append(svg("text", {x: x + 11, y: y - 5, "text-anchor": "middle"}, numberText(sum, sum < 10 ? 1 : 0)),
      svg("text", {x: x + 11, y: 158, "text-anchor": "middle"}, MONTHS[i].slice(0, 3)));
  });
  plot.append(svg("path", {d: "M4 142H362", class: "axis"}));
  return plot;
}
