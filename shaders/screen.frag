#version 450 core
// The transmittance of a ray through a perforated sheet, which multiplies the luminance. Each kind
// of holes has its own program, with one of these defined: PATTERN; TEXTURE; TEXTURE and REGIONS,
// over which the effective transmittance varies.

// As in screen.vert.
flat in vec4 ray;
flat in vec4 tile;
flat in vec4 hole;
flat in vec4 effective;
flat in ivec4 kind;
flat in ivec4 image;
flat in vec4 texels;

// As in screen.geom.
in vec2 place;
in vec4 within;
flat in vec4 within_step;

out vec4 fragment;

#ifdef TEXTURE

layout(binding = 0) uniform sampler2DArray opacity_layers;

float opacity(vec2 p) {
  vec2 texel = fract(p / tile.xy) * texels.xy;
  vec2 side = vec2(image.yz);
  vec2 layer = floor(texel / side);
  // Each layer has a border of one texel.
  vec2 at = (texel - layer * side + 1.0) / (side + 2.0);
  return textureLod(opacity_layers, vec3(at, layer.y * float(image.w) + layer.x), 0.0).r;
}

float solid(vec2 p) {
  float found = opacity(p);
  return hole.w < 0.0 ? found : float(found > hole.w);
}

#else

const int round_hole = 1;  // slots too
const int square_hole = 2;
const int hexagonal_hole = 3;

bool in_hole(vec2 from_centre) {
  vec2 d = abs(from_centre);
  float half_size = hole.x;
  if (kind.x == square_hole) return max(d.x, d.y) <= half_size;
  if (kind.x == hexagonal_hole) {
    return d.x <= half_size && 0.5 * d.x + 0.8660254 * d.y <= half_size;
  }
  d.x = max(d.x - hole.y, 0.0);
  return dot(d, d) <= half_size * half_size;
}

bool find_hole(vec2 p, out vec2 centre) {
  centre = tile.xy * round(p / tile.xy);
  if (in_hole(p - centre)) return true;
  if (hole.z == 0.0) return false;
  centre = tile.xy * (floor(p / tile.xy) + 0.5);
  return in_hole(p - centre);
}

float solid(vec2 p) {
  vec2 centre;
  return find_hole(p, centre) ? 0.0 : 1.0;
}

// Holes are convex: a ray that is in a hole at both ends is in it all the way.
float through_hole(float begin, float end) {
  vec2 centre;
  return find_hole(place + begin * ray.xy, centre) && in_hole(place + end * ray.xy - centre) ? 1.0
                                                                                            : 0.0;
}

#endif

// Layers at equal steps that are inside the outline, and the points where the ray crosses the
// outline, so that it steps over nothing between the sheet's side and the next layer.
float through_layers(float begin, float end) {
  int layers = kind.y;
  float most = 0.0;
  for (int k = begin > 0.0 || end < 1.0 ? -2 : 0; k < layers && most < 1.0; ++k) {
    float depth = layers == 1 ? 0.5 : float(k) / float(layers - 1);
    if (k < 0) depth = k == -2 ? begin : end;
    if (depth >= begin && depth <= end) most = max(most, solid(place + depth * ray.xy));
  }
  return 1.0 - most;
}

float through_holes(float begin, float end) {
#ifdef PATTERN
  if (kind.y < 0) return through_hole(begin, end);
#endif
  return through_layers(begin, end);
}

// Linear interpolation between the values for thirds of the path.
float along(vec4 thirds, float way) {
  vec3 part = clamp(vec3(3.0 * way) - vec3(0.0, 1.0, 2.0), 0.0, 1.0);
  return thirds.x + dot(thirds.yzw - thirds.xyz, part);
}

#ifdef REGIONS

layout(std430, binding = 3) readonly buffer Regions { vec4 regions[]; };  // thirds of each

vec4 region(ivec2 at) {
  ivec2 count = ivec2(kind.w, image.x);
  ivec2 found = (at + count) % count;
  return regions[kind.z + found.y * count.x + found.x];
}

float through_effective(float begin, float end) {
  vec2 middle = place + 0.5 * (begin + end) * ray.xy;
  vec2 at = fract(middle / tile.xy) * vec2(kind.w, image.x) - 0.5;
  ivec2 corner = ivec2(floor(at));
  vec2 part = at - floor(at);
  vec4 below = mix(region(corner), region(corner + ivec2(1, 0)), part.x);
  vec4 above = mix(region(corner + ivec2(0, 1)), region(corner + 1), part.x);
  return along(mix(below, above, part.y), end - begin);
}

#else

float through_effective(float begin, float end) { return along(effective, end - begin); }

#endif

float through(float pixel) {
  if (kind.y == 0) return 0.0;
  // The part of the path inside the outline.
  vec4 last = within + within_step;
  vec4 crossing = within / (within - last);
  vec4 from = mix(vec4(0.0), crossing, lessThan(within, vec4(0.0)));
  vec4 to = mix(vec4(1.0), crossing, lessThan(last, vec4(0.0)));
  bool outside = any(lessThan(max(within, last), vec4(0.0)));
  float begin = max(max(from.x, from.y), max(from.z, from.w));
  float end = min(min(to.x, to.y), min(to.z, to.w));
  if (outside || begin > end) return 1.0;
  float blend = smoothstep(tile.z, tile.w, pixel);
  float passed = 0.0;
  if (blend < 1.0) passed = through_holes(begin, end);
  if (blend > 0.0) passed = mix(passed, through_effective(begin, end), blend);
  return passed;
}

void main() {
  vec2 across = dFdx(place);
  vec2 up = dFdy(place);
  float pixel = sqrt(abs(across.x * up.y - across.y * up.x));
  fragment = vec4(vec3(0.0), 1.0 - ray.w * (1.0 - through(pixel)));
}
