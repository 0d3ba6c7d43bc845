// Makes objects between camera and vehicle look like a sieve, so that nothing hides the vehicle.

export const SIEVE_RADIUS = 1.5; // m about the line to the vehicle

/** For both shaders: how far along the line a place is (1: at the vehicle; orthographic: metres before it), and how far aside. */
export const SIEVE_WAY = 'varying float along; varying vec3 aside;';

/** For a vertex shader with `seen`, the place in the camera's frame, and the uniform `vehicle`. Both are linear there. */
export const SIEVE_PLACE = `
  vec3 target = (viewMatrix * vec4(vehicle, 1.0)).xyz;
  along = isOrthographic ? seen.z - target.z : dot(seen, target) / dot(target, target);
  aside = isOrthographic ? vec3(seen.xy - target.xy, 0.0) : seen - along * target;
  if (dot(target, target) < 1.0) along = isOrthographic ? 0.0 : 1.0; // not for who sits in it`;

/** For a fragment shader. */
export const SIEVE = `
  if (isOrthographic ? along > 0.1 : along < 0.97) {
    float off = length(aside) / (isOrthographic ? 1.0 : 0.35 + 0.65 * along);
    if (off < ${SIEVE_RADIUS.toFixed(1)}) {
      float keep = mix(0.12, 1.0, smoothstep(0.7, ${SIEVE_RADIUS.toFixed(1)}, off));
      float sieve = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
      if (sieve > keep) discard;
    }
  }`;

/** Turns a material of three into a sieve. @param vehicle  its position; the reference is stored */
export function cutaway(material, vehicle) {
  const before = material.onBeforeCompile;
  material.onBeforeCompile = (shader) => {
    before(shader);
    shader.uniforms.vehicle = { value: vehicle };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${SIEVE_WAY} uniform vec3 vehicle;`)
      .replace('#include <project_vertex>', `#include <project_vertex>\nvec3 seen = mvPosition.xyz; ${SIEVE_PLACE}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\n${SIEVE_WAY}`)
      .replace('#include <clipping_planes_fragment>', SIEVE);
  };
  return material;
}
