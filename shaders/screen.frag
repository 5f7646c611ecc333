#version 450 core
// What a ray keeps that goes through a perforated sheet, to multiply the luminance by.

struct Screen {
  vec4 shift_deployed_threshold;  // as in screen.vert; the share of the screen that is in place; the
                                  // opacity above which it is solid, -1: opacity multiplies
  vec4 tile_blend;                // m; pixels' size in the sheet, m, up to which holes are drawn
                                  // one by one, and from which only their effect is
  vec4 hole;                      // half of the size, half of a slot's straight part, m; staggered
  ivec4 kind_layers_effective;    // shape; layers, 0 solid, -1 exactly; first value, regions along u
  ivec4 regions_texture;          // regions along v; columns and rows of a layer of the texture,
                                  // and layers along u
  vec4 texels;                    // of the texture along u and v
};
layout(std430, binding = 3) readonly buffer Screens { Screen screens[]; };
layout(std430, binding = 4) readonly buffer Effective { float effective[]; };
layout(binding = 0) uniform sampler2DArray texture_opacity;

in vec2 place;
in vec4 within;
flat in vec4 within_step;
flat in uint screen;

out vec4 fragment;

const int shape_texture = 0;
const int shape_round = 1;  // slots too
const int shape_square = 2;
const int shape_hexagonal = 3;

const int effective_steps = 8;  // from no way in the sheet to all of it

bool in_hole(Screen s, vec2 from_centre) {
  vec2 d = abs(from_centre);
  float size = s.hole.x;
  if (s.kind_layers_effective.x == shape_square) return max(d.x, d.y) <= size;
  if (s.kind_layers_effective.x == shape_hexagonal) {
    return d.x <= size && 0.5 * d.x + 0.8660254 * d.y <= size;
  }
  d.x = max(d.x - s.hole.y, 0.0);
  return dot(d, d) <= size * size;
}

bool find_hole(Screen s, vec2 p, out vec2 centre) {
  vec2 tile = s.tile_blend.xy;
  centre = tile * round(p / tile);
  if (in_hole(s, p - centre)) return true;
  if (s.hole.z == 0.0) return false;
  centre = tile * (floor(p / tile) + 0.5);
  return in_hole(s, p - centre);
}

float opacity(Screen s, vec2 p) {
  vec2 texel = fract(p / s.tile_blend.xy) * s.texels.xy;
  vec2 cell = vec2(s.regions_texture.yz);
  vec2 layer = floor(texel / cell);
  // A border of one texel around each layer.
  vec2 at = (texel - layer * cell + 1.0) / (cell + 2.0);
  return textureLod(texture_opacity, vec3(at, layer.y * float(s.regions_texture.w) + layer.x), 0.0).r;
}

// Through layers at equal steps, those of them that are within the sheet's outline, and where the
// ray crosses that, so that it steps over nothing between the sheet's side and the next layer.
float through_layers(Screen s, float begin, float end) {
  int layers = s.kind_layers_effective.y;
  float threshold = s.shift_deployed_threshold.w;
  float most = 0.0;
  for (int k = begin > 0.0 || end < 1.0 ? -2 : 0; k < layers; ++k) {
    float depth = layers == 1 ? 0.5 : float(k) / float(layers - 1);
    if (k < 0) depth = k == -2 ? begin : end;
    if (depth < begin || depth > end) continue;
    vec2 p = place + depth * s.shift_deployed_threshold.xy;
    if (s.kind_layers_effective.x == shape_texture) {
      float here = opacity(s, p);
      if (threshold < 0.0) {
        most = max(most, here);
      } else if (here > threshold) {
        return 0.0;
      }
    } else {
      vec2 centre;
      if (!find_hole(s, p, centre)) return 0.0;
    }
  }
  return 1.0 - most;
}

// Holes are convex: who is in one at both ends has been in it all the way.
float through_hole(Screen s, float begin, float end) {
  vec2 shift = s.shift_deployed_threshold.xy;
  vec2 centre;
  return find_hole(s, place + begin * shift, centre) && in_hole(s, place + end * shift - centre)
             ? 1.0
             : 0.0;
}

float region(Screen s, ivec2 at, float way) {
  ivec2 count = ivec2(s.kind_layers_effective.w, s.regions_texture.x);
  ivec2 found = (at + count) % count;
  int first = s.kind_layers_effective.z + (found.y * count.x + found.x) * (effective_steps + 1);
  int below = min(int(way), effective_steps - 1);
  return mix(effective[first + below], effective[first + below + 1], way - float(below));
}

float through_effective(Screen s, float begin, float end) {
  float way = (end - begin) * float(effective_steps);
  vec2 count = vec2(s.kind_layers_effective.w, s.regions_texture.x);
  if (count == vec2(1.0)) return region(s, ivec2(0), way);
  vec2 middle = place + 0.5 * (begin + end) * s.shift_deployed_threshold.xy;
  vec2 at = fract(middle / s.tile_blend.xy) * count - 0.5;
  ivec2 corner = ivec2(floor(at));
  vec2 part = at - floor(at);
  return mix(mix(region(s, corner, way), region(s, corner + ivec2(1, 0), way), part.x),
             mix(region(s, corner + ivec2(0, 1), way), region(s, corner + 1, way), part.x), part.y);
}

float through(Screen s, float pixel) {
  if (s.kind_layers_effective.y == 0) return 0.0;
  // The part of the way that is within the outline.
  float begin = 0.0;
  float end = 1.0;
  for (int k = 0; k < 4; ++k) {
    float first = within[k];
    float last = first + within_step[k];
    if (first < 0.0 && last < 0.0) return 1.0;
    if (first < 0.0) begin = max(begin, first / (first - last));
    if (last < 0.0) end = min(end, first / (first - last));
  }
  if (begin > end) return 1.0;
  float blend = smoothstep(s.tile_blend.z, s.tile_blend.w, pixel);
  float passed = 0.0;
  if (blend < 1.0) {
    passed = s.kind_layers_effective.y < 0 ? through_hole(s, begin, end)
                                           : through_layers(s, begin, end);
  }
  if (blend > 0.0) passed = mix(passed, through_effective(s, begin, end), blend);
  return passed;
}

void main() {
  vec2 across = dFdx(place);
  vec2 up = dFdy(place);
  float pixel = sqrt(abs(across.x * up.y - across.y * up.x));
  Screen s = screens[screen];
  fragment = vec4(vec3(0.0), 1.0 - s.shift_deployed_threshold.z * (1.0 - through(s, pixel)));
}
