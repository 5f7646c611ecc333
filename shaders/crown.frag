#version 450 core
// Outputs 0 and the transmittance of a crown along the ray through the face of its box that is
// towards the sun, as CrownSolid::inside finds the path. The faces of a mesh output factors whose
// product is the transmittance: a path is the sum of the distances at which its ray leaves the mesh,
// less those at which it enters.

in vec3 position;
in float kept;
flat in vec3 along;
flat in float rise;
flat in vec3 solid;
flat in float extinction;
flat in float hand;

out vec4 fragment;

const float far = 1e30;

// Where a ray is inside, in metres towards the sun; x is more than y where it is nowhere.
vec2 inside() {
  vec2 ends = vec2(-far, far);
  if (along.z != 0.0) {
    vec2 crossings = (vec2(-1.0, 1.0) - position.z) / along.z;
    ends = vec2(min(crossings.x, crossings.y), max(crossings.x, crossings.y));
  }
  float a = dot(along.xy, along.xy) + solid.x * along.z * along.z;
  float b = dot(position.xy, along.xy) + (solid.x * position.z + 0.5 * solid.y) * along.z;
  float c = dot(position.xy, position.xy) + (solid.x * position.z + solid.y) * position.z + solid.z;
  float discriminant = b * b - a * c;
  if (a > 0.0 && discriminant <= 0.0) return vec2(far, -far);
  // Along a cylinder or the side of a cone: b is positive if the ray leaves it.
  if (a == 0.0) {
    if (b == 0.0) return c < 0.0 ? ends : vec2(far, -far);
    float crossing = -0.5 * c / b;
    return b > 0.0 ? vec2(ends.x, min(ends.y, crossing)) : vec2(max(ends.x, crossing), ends.y);
  }
  if (discriminant <= 0.0) return ends;
  float root = sqrt(discriminant);
  float farther = b >= 0.0 ? -(b + root) : root - b;
  float one = farther / a;
  float other = c / farther;
  float first = min(one, other);
  float last = max(one, other);
  if (a > 0.0) return vec2(max(ends.x, first), min(ends.y, last));
  // The part below a cone's apex; another cone stands on it.
  return along.z > 0.0 ? vec2(ends.x, min(ends.y, first)) : vec2(max(ends.x, last), ends.y);
}

// Of the ray through a mesh's face, from the middle of the crown.
float distance_kept() {
  float squared = dot(along, along);  // the inverse of the mesh's reach
  float distance = dot(position, along) / squared;
  if (rise > 0.0) distance = max(distance, min(distance - kept / rise, inversesqrt(squared)));
  return (gl_FrontFacing ? hand : -hand) * distance;
}

void main() {
  if (solid == vec3(0.0)) {
    fragment = vec4(vec3(0.0), exp(-extinction * distance_kept()));
    return;
  }
  vec2 path = inside();
  if (rise > 0.0) path.x = max(path.x, -kept / rise);
  float passed = exp(-extinction * max(0.0, path.y - path.x));
  fragment = vec4(vec3(0.0), passed);
}
