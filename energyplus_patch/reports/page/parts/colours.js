// Colours of sunlit fractions (cividis), and of everything else in a light and a dark theme.

function isDark() { return matchMedia("screen and (prefers-color-scheme: dark)").matches; }

const THEMES = {
  light: {caster: [196, 190, 180], turnedAway: [128, 138, 152], ground: [226, 228, 226], edge: 0x30353b, screen: 0x4a4038,
    glass: 0x2f7f9f, foliage: 0x4f7d33, wood: 0x7d6f60, north: "#9c1c1c", horizon: 0x8a9098, path: 0xb06a00, text: "#1b1f24",
    halo: "#ffffffd0", choice: 0xb8004d},
  dark: {caster: [112, 110, 106], turnedAway: [92, 101, 114], ground: [44, 50, 57], edge: 0x0b0d0f, screen: 0xd8cbb8,
    glass: 0x7cc9e6, foliage: 0x9cc97a, wood: 0xa3988a, north: "#ff9d8a", horizon: 0x78808a, path: 0xffc266, text: "#e7eaee",
    halo: "#14171bd0", choice: 0xff8fb8},
};
let printing = false;
function theme() { return isDark() && !printing ? THEMES.dark : THEMES.light; }

// Red, green, blue, 0 .. 255, of a value from 0 to 1.
function scaleColour(value) {
  const last = content.colours.length - 1;
  return content.colours[Math.round(Math.min(Math.max(value, 0), 1) * last)];
}

function percentColour(percent) {
  return percent === content.turnedAway ? theme().turnedAway : scaleColour(percent / 100);
}

function css(colour) { return `rgb(${colour.join(",")})`; }

function scaleGradient() {
  const stops = content.colours.filter((_, i) => i % 4 === 0).map(css);
  return `linear-gradient(to right, ${stops.join(",")})`;
}
