#version 450 core
// For a convex quadrilateral of a sheet, emits everything that its thickness covers as the sun sees
// it: the inside face, and the strip to the outside face from each of its edges that faces the sun.
// These do not overlap, so every ray meets one fragment, which searches for its path through the
// layers.

layout(lines_adjacency) in;
layout(triangle_strip, max_vertices = 20) out;

in Corner {
  int layer;
  vec4 inside;
  vec4 outside;
  vec2 place;
  float kept;
  vec4 ray;
  vec4 tile;
  vec4 hole;
  vec4 effective;
  ivec4 kind;
  ivec4 image;
  vec4 texels;
}
corners[];

// As in screen.vert; fragments read one value each.
flat out vec4 ray;
flat out vec4 tile;
flat out vec4 hole;
flat out vec4 effective;
flat out ivec4 kind;
flat out ivec4 image;
flat out vec4 texels;

out vec2 place;             // where the ray passes the inside face, m in the sheet's plane
out vec4 within;            // there, its distance from each edge times the edge's length
flat out vec4 within_step;  // change of this distance from face to face

float crossed(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

vec2 edge(int i) { return corners[(i + 1) % 4].place - corners[i].place; }

// Twice the area of the quadrilateral.
float turn(vec2 a, vec2 b, vec2 c, vec2 d) { return crossed(c - a, d - b); }

float handed;  // 1 if the corners run counterclockwise in the sheet's plane, otherwise -1

void send(int i, bool outside) {
  vec2 shift = corners[i].ray.xy;
  vec2 here = outside ? corners[i].place - shift : corners[i].place;
  // Outputs are written as a whole: not every driver indexes them in a loop.
  vec4 distances;
  vec4 changes;
  for (int k = 0; k < 4; ++k) {
    distances[k] = handed * crossed(edge(k), here - corners[k].place);
    changes[k] = handed * crossed(edge(k), shift);
  }
  place = here;
  within = distances;
  within_step = changes;
  ray = corners[i].ray;
  tile = corners[i].tile;
  hole = corners[i].hole;
  effective = corners[i].effective;
  kind = corners[i].kind;
  image = corners[i].image;
  texels = corners[i].texels;
  gl_Position = outside ? corners[i].outside : corners[i].inside;
  gl_ClipDistance[0] = corners[i].kept;
  gl_Layer = corners[i].layer;
  EmitVertex();
}

void main() {
  handed = turn(corners[0].place, corners[1].place, corners[2].place, corners[3].place) < 0.0
               ? -1.0
               : 1.0;
  send(0, false);
  send(1, false);
  send(3, false);
  send(2, false);
  EndPrimitive();

  vec2 slide = corners[0].outside.xy - corners[0].inside.xy;
  float seen = turn(corners[0].inside.xy, corners[1].inside.xy, corners[2].inside.xy,
                    corners[3].inside.xy);
  for (int i = 0; i < 4; ++i) {
    int next = (i + 1) % 4;
    vec2 along = corners[next].inside.xy - corners[i].inside.xy;
    if (crossed(along, slide) * (seen < 0.0 ? -1.0 : 1.0) >= 0.0) continue;
    send(i, false);
    send(next, false);
    send(i, true);
    send(next, true);
    EndPrimitive();
  }
}
