#version 450 core
// Transforms a corner of a perforated sheet, at both of its faces, to its position in a view, like
// slide.vert.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in vec2 corner;  // m in the sheet's plane
layout(location = 3) in int screen;

// The view, per instance.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 cut;
layout(location = 8) in vec4 origin_high;
layout(location = 9) in vec4 origin_low;
layout(location = 10) in ivec4 numbers;  // layer of the target; w: first sheet of the sun direction

struct Sheet {
  vec4 normal;     // unit normal; the inside face along it from the polygon, m
  vec4 ray;        // its displacement towards the sun from the inside to the outside face, m in the sheet's
                   // plane; the outside face along the normal, m; deployed fraction of the screen
  vec4 tile;       // width and height, m; pixels' size in the sheet, m, up to which holes are drawn
                   // one by one, and from which on only their effective transmittance is
  vec4 hole;       // half of its size, half of a slot's straight part, m; 1 where staggered; opacity
                   // above which a texture is solid, -1: it multiplies
  vec4 effective;  // transmittance at zero, one, two and three thirds of the path
  ivec4 kind;      // shape; layers, 0 solid, -1 exactly; first region, regions along u
  ivec4 image;     // regions along v; columns and rows of a layer of the texture, layers along u
  vec4 texels;     // of the image along u and v
};
layout(std430, binding = 2) readonly buffer Sheets { Sheet sheets[]; };

out Corner {
  int layer;
  vec4 inside;
  vec4 outside;
  vec2 place;  // m in the sheet's plane
  float kept;
  vec4 ray;
  vec4 tile;
  vec4 hole;
  vec4 effective;
  ivec4 kind;
  ivec4 image;
  vec4 texels;
}
result;

vec4 slid(vec3 p) {
  return vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
              dot(row_z.xyz, p) + row_z.w, 1.0);
}

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  Sheet sheet = sheets[numbers.w + screen];
  result.layer = numbers.x;
  result.inside = slid(p + sheet.normal.w * sheet.normal.xyz);
  result.outside = slid(p + sheet.ray.z * sheet.normal.xyz);
  result.place = corner;
  // The sheet is clipped where its polygon or the middle of its body is, whichever is in front.
  float middle = 0.5 * (sheet.normal.w + sheet.ray.z);
  result.kept = dot(cut.xyz, p) + cut.w + max(0.0, middle * dot(cut.xyz, sheet.normal.xyz));
  result.ray = sheet.ray;
  result.tile = sheet.tile;
  result.hole = sheet.hole;
  result.effective = sheet.effective;
  result.kind = sheet.kind;
  result.image = sheet.image;
  result.texels = sheet.texels;
  gl_Position = result.inside;
}
