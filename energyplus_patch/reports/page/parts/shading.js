// Materials: flat colours that are darker in shadow, so that they still agree with the scale.

// Instead of how much tilt counts: neither tilt nor shadow do.
const AS_IT_IS = -1;

const VERTEX = `
attribute vec4 tint; // rgb, and how much the tilt of the surface may change them
uniform vec3 sun;
uniform float lift;
varying vec3 facing;
varying vec4 shade;
#include <shadowmap_pars_vertex>
void main() {
  #include <begin_vertex>
  #include <project_vertex>
  facing = normal;
  shade = tint;
  // Off the surface, towards the sun: a surface must not shade itself.
  vec4 worldPosition = modelMatrix * vec4(transformed + lift * (dot(normal, sun) < 0.0 ? -normal : normal), 1.0);
  #include <shadowmap_vertex>
}`;

const FRAGMENT = `
uniform vec3 sun;
uniform float shadows;
varying vec3 facing;
varying vec4 shade;
#include <common>
#include <packing>
#include <bsdfs>
#include <lights_pars_begin>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
  vec3 seen = gl_FrontFacing ? facing : -facing;
  float towards = dot(seen, sun);
  float lit = towards > 0.0 ? getShadowMask() : 0.0;
  float tilt = 0.88 + 0.12 * dot(seen, normalize(vec3(0.35, -0.55, 0.75)));
  float dim = mix(1.0, mix(0.6, 1.0, lit), shadows);
  gl_FragColor = vec4(shade.a < 0.0 ? shade.rgb : shade.rgb * mix(1.0, tilt, shade.a) * dim, 1.0);
}`;

function surfaceMaterial() {
  return new THREE.ShaderMaterial({
    uniforms: THREE.UniformsUtils.merge([THREE.UniformsLib.lights,
      {sun: {value: new THREE.Vector3(0, 0, 1)}, lift: {value: 0.05}, shadows: {value: 1}}]),
    vertexShader: VERTEX, fragmentShader: FRAGMENT, lights: true, side: THREE.DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
}

// In the shadow map, a sheet passes light through holes; glass, which passes a share everywhere, through a fine raster.
function depthMaterial(texture) {
  return new THREE.MeshDepthMaterial({depthPacking: THREE.RGBADepthPacking, alphaMap: texture, alphaTest: 0.5,
    side: THREE.DoubleSide});
}
