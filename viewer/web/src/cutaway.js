// Nothing hides the vehicle: what stands before it, as seen from the camera, is drawn as a sieve.

/** Of a fragment shader that has `seen`, its place in the camera's frame, and the uniform `vehicle`. */
export const SIEVE = `
  vec3 target = (viewMatrix * vec4(vehicle, 1.0)).xyz;
  float along = isOrthographic ? (seen.z > target.z + 0.1 ? 0.5 : 1.0) : dot(seen, target) / dot(target, target);
  float aside = isOrthographic ? length(seen.xy - target.xy) : length(seen - along * target) / (0.35 + 0.65 * along);
  if (along < 0.97 && aside < 1.5 && dot(target, target) > 1.0) { // not for who sits in it
    float keep = mix(0.12, 1.0, smoothstep(0.7, 1.5, aside));
    float sieve = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
    if (sieve > keep) discard;
  }`;

/** Makes a sieve of a material of three's. @param vehicle  where it is; kept */
export function cutaway(material, vehicle) {
  material.onBeforeCompile = (shader) => {
    shader.uniforms.vehicle = { value: vehicle };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nvarying vec3 seen;')
      .replace('#include <project_vertex>', '#include <project_vertex>\nseen = mvPosition.xyz;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec3 seen; uniform vec3 vehicle;')
      .replace('#include <clipping_planes_fragment>', SIEVE);
  };
  return material;
}
