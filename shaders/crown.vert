#version 450 core
#extension GL_ARB_shader_viewport_layer_array : enable
// slide.vert for the corners of a crown's box or mesh. Of a box, the faces towards the sun are drawn,
// which a ray meets once; crown.frag finds the path from there. Of a mesh, all are.

layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in vec3 corner;  // in the cube from -1 to 1 that the box becomes
layout(location = 3) in int surface;

// The view, per instance.
layout(location = 4) in vec4 row_x;
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;
layout(location = 7) in vec4 cut;
layout(location = 8) in vec4 origin_high;
layout(location = 9) in vec4 origin_low;
layout(location = 10) in ivec4 numbers;  // layer; z: first shade of the sun direction

// From a vector of the scene to one in the cube, by rows; the crown's solid (CrownSolid); and the
// normal of the face in the cube. Of a mesh, the last two are 0.
layout(location = 11) in vec3 to_x;
layout(location = 12) in vec3 to_y;
layout(location = 13) in vec3 to_z;
layout(location = 14) in vec3 solid_in;
layout(location = 15) in vec3 facing;

// As in transmit.vert.
struct Shade {
  float transmittance;
  int schedule;
  float extinction;  // of a crown, per metre
};
layout(std430, binding = 0) readonly buffer Shades { Shade shades[]; };

out vec3 position;      // in the cube
out float kept;         // metres in front of the view's plane
flat out vec3 along;    // in the cube, per metre towards the sun
flat out float rise;    // of `kept`, per metre towards the sun
flat out vec3 solid;
flat out float extinction;
flat out float hand;    // -1 if what faces the sun is clockwise in the view

void main() {
  precise vec3 p = (high - origin_high.xyz) + (low - origin_low.xyz);
  vec3 towards_sun = normalize(cross(row_x.xyz, row_y.xyz));
  // A view that is not cut is one of a picture, whose z leads away.
  float forwards = dot(cut.xyz, towards_sun);
  if (forwards == 0.0) forwards = -dot(row_z.xyz, towards_sun);
  hand = forwards < 0.0 ? -1.0 : 1.0;
  towards_sun *= hand;
  position = corner;
  kept = dot(cut.xyz, p) + cut.w;
  along = vec3(dot(to_x, towards_sun), dot(to_y, towards_sun), dot(to_z, towards_sun));
  rise = dot(cut.xyz, towards_sun);
  solid = solid_in;
  extinction = shades[numbers.z + surface].extinction;
  gl_Position = vec4(dot(row_x.xyz, p) + row_x.w, dot(row_y.xyz, p) + row_y.w,
                     dot(row_z.xyz, p) + row_z.w, 1.0);
  // Outside of the view, at one place: nothing is drawn.
  if (solid != vec3(0.0) && dot(facing, along) <= 0.0) gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
#ifdef GL_ARB_shader_viewport_layer_array
  gl_Layer = numbers.x;
#endif
}
