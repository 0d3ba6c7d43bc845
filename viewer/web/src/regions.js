// The semantic map: outer faces of labelled voxels as translucent volumes with a faint grid of the voxels.
import * as THREE from 'three';
import { numbers, point } from './form.js';
import { palette } from './palette.js';

const NUMBERS_PER_FACE = 8; // label, direction, low x y z, high x y z
const LABELS = {
  2: { color: palette.occupied, opacity: 0.5 },
  3: { color: palette.attractive, opacity: 0.13 },
  4: { color: palette.repulsive, opacity: 0.15 },
};

function material(color, opacity, origin, resolution) {
  return new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    side: THREE.DoubleSide,
    uniforms: {
      color: { value: new THREE.Color(color) },
      opacity: { value: opacity },
      origin: { value: new THREE.Vector3(...origin) },
      resolution: { value: resolution },
    },
    vertexShader: `varying vec3 at; varying vec3 n; void main() {
      at = position; n = normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `varying vec3 at; varying vec3 n; uniform vec3 color, origin; uniform float opacity, resolution;
      void main() {
        vec3 q = (at - origin) / resolution; vec3 w = fwidth(q);
        vec3 d = abs(fract(q - 0.5) - 0.5) / max(w, vec3(1e-5)) + 8.0 * abs(n);
        float line = (1.0 - min(min(d.x, min(d.y, d.z)), 1.0)) * clamp(0.55 - 1.4 * max(w.x, max(w.y, w.z)), 0.0, 1.0);
        float rise = 0.75 + 0.5 * smoothstep(4.0, 0.0, at.z);
        gl_FragColor = vec4(color, opacity * rise + 0.16 * line);
        #include <colorspace_fragment>
      }`,
  });
}

/** Corners of a face, counter-clockwise seen from outside. */
function corners(direction, low, high) {
  const axis = direction >> 1;
  const u = (axis + 1) % 3;
  const v = (axis + 2) % 3;
  const corner = (a, b) => {
    const c = [...low];
    c[u] = a ? high[u] : low[u];
    c[v] = b ? high[v] : low[v];
    return c;
  };
  const around = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
  return direction & 1 ? around : around.reverse();
}

export class Regions {
  constructor(scene) {
    this.group = new THREE.Group();
    scene.add(this.group);
  }

  clear() {
    for (const mesh of this.group.children) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.clear();
  }

  /** @param map  {origin, resolution, faces}: eight integers per face, corners in voxels */
  take(map) {
    numbers(map.faces, NUMBERS_PER_FACE);
    point(map.origin);
    this.clear();
    for (const [label, look] of Object.entries(LABELS)) {
      const geometry = this.geometry(map, Number(label));
      if (!geometry) continue;
      const mesh = new THREE.Mesh(geometry, material(look.color, look.opacity, map.origin, map.resolution));
      mesh.renderOrder = 1;
      this.group.add(mesh);
    }
  }

  geometry({ faces, origin, resolution }, label) {
    const positions = [];
    const normals = [];
    const index = [];
    for (let k = 0; k < faces.length; k += NUMBERS_PER_FACE) {
      if (faces[k] !== label) continue;
      const direction = faces[k + 1];
      const first = positions.length / 3;
      for (const c of corners(direction, faces.slice(k + 2, k + 5), faces.slice(k + 5, k + 8))) {
        positions.push(...c.map((x, axis) => origin[axis] + resolution * x));
        normals.push(...[0, 1, 2].map((axis) => (axis === direction >> 1 ? (direction & 1 ? 1 : -1) : 0)));
      }
      index.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
    if (index.length === 0) return null;
    return new THREE.BufferGeometry()
      .setAttribute('position', new THREE.Float32BufferAttribute(positions, 3))
      .setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3))
      .setIndex(index);
  }

  hit(raycaster) {
    if (!this.group.visible) return null;
    return raycaster.intersectObjects(this.group.children)[0] ?? null;
  }
}
