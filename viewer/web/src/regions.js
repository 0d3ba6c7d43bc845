// The semantic map: outer faces of labelled voxels. Occupied voxels are solid, regions are translucent.
import * as THREE from 'three';
import { SIEVE, SIEVE_PLACE, SIEVE_WAY } from './cutaway.js';
import { numbers, point } from './form.js';
import { palette } from './palette.js';

const NUMBERS_PER_FACE = 8; // label, direction, low x y z, high x y z
const OCCUPIED = 2;
const NO_CUT = 1e9; // m
const LABELS = {
  [OCCUPIED]: { color: palette.occupied },
  3: { color: palette.attractive, opacity: 0.13 },
  4: { color: palette.repulsive, opacity: 0.15 },
};

const VERTEX = `varying vec3 at; varying vec3 n; uniform vec3 vehicle; ${SIEVE_WAY} void main() {
  at = position; n = normal;
  vec3 seen = (modelViewMatrix * vec4(position, 1.0)).xyz;
  ${SIEVE_PLACE}
  gl_Position = projectionMatrix * vec4(seen, 1.0); }`;

/** The intensity of a voxel's edge at this point, 0 … 1. */
const GRID = `float grid() {
    vec3 q = (at - origin) / resolution; vec3 w = fwidth(q);
    vec3 d = abs(fract(q - 0.5) - 0.5) / max(w, vec3(1e-5)) + 8.0 * abs(n);
    return (1.0 - min(min(d.x, min(d.y, d.z)), 1.0)) * clamp(0.55 - 1.4 * max(w.x, max(w.y, w.z)), 0.0, 1.0);
  }`;

/** The same for solid faces: near edges are a share of a voxel wide, far ones a pixel. */
const EDGE = `float edge() {
    vec3 q = (at - origin) / resolution; vec3 w = fwidth(q);
    vec3 d = abs(fract(q - 0.5) - 0.5) + abs(n);
    vec3 here = 1.0 - smoothstep(vec3(0.012), vec3(0.02) + w, d);
    return max(here.x, max(here.y, here.z)) * clamp(1.1 - 2.4 * max(w.x, max(w.y, w.z)), 0.0, 1.0);
  }`;

/** A region, which the vehicle may fly through: translucent. */
const AIRY = `varying vec3 at; varying vec3 n; uniform vec3 color, origin; uniform float opacity, resolution;
  ${GRID}
  void main() {
    float rise = 0.75 + 0.5 * smoothstep(4.0, 0.0, at.z);
    gl_FragColor = vec4(color, opacity * rise + 0.16 * grid());
    #include <colorspace_fragment>
  }`;

/** Occupied voxels: solid, with edges, cut off above `cut`. The cut shows their inside, darker. */
const SOLID = `varying vec3 at; varying vec3 n; ${SIEVE_WAY}
  uniform vec3 color, origin, lit[6]; uniform float resolution, cut;
  ${EDGE}
  void main() {
    if (at.z > cut) discard;
    ${SIEVE}
    vec3 light = n.x < -0.5 ? lit[0] : n.x > 0.5 ? lit[1] : n.y < -0.5 ? lit[2] : n.y > 0.5 ? lit[3] : n.z < -0.5 ? lit[4] : lit[5];
    vec3 c = color * (gl_FrontFacing ? light : vec3(0.28)) * (gl_FrontFacing ? 1.0 - 0.4 * edge() : 1.0);
    gl_FragColor = vec4(c, 1.0);
    #include <colorspace_fragment>
  }`;

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
  /** @param vehicle  its position; the reference is stored */
  constructor(world, vehicle) {
    this.group = new THREE.Group();
    this.shown = { walls: true, regions: true };
    this.vehicle = vehicle;
    this.cut = { value: NO_CUT };
    const sides = [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]];
    this.lit = sides.map((n) => new THREE.Vector3(...world.lightOn(new THREE.Vector3(...n)).toArray()));
    world.scene.add(this.group);
  }

  clear() {
    for (const mesh of this.group.children) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.group.clear();
    this.top = 0;
  }

  /** @param map  {origin, resolution, faces}: eight integers per face, corners in voxels */
  take(map) {
    numbers(map.faces, NUMBERS_PER_FACE);
    point(map.origin);
    this.clear();
    for (const label of Object.keys(LABELS).map(Number)) {
      const geometry = this.geometry(map, label);
      if (!geometry) continue;
      const mesh = new THREE.Mesh(geometry, this.material(label, map));
      mesh.name = label === OCCUPIED ? 'walls' : 'regions';
      mesh.visible = this.shown[mesh.name];
      mesh.renderOrder = label === OCCUPIED ? 0 : 1;
      this.group.add(mesh);
      if (label !== OCCUPIED) continue;
      geometry.computeBoundingBox();
      this.top = geometry.boundingBox.max.z;
    }
  }

  material(label, { origin, resolution }) {
    const { color, opacity } = LABELS[label];
    const isSolid = label === OCCUPIED;
    return new THREE.ShaderMaterial({
      transparent: !isSolid,
      depthWrite: isSolid,
      side: isSolid ? this.side() : THREE.DoubleSide,
      uniforms: {
        color: { value: new THREE.Color(color) },
        opacity: { value: opacity ?? 1 },
        origin: { value: new THREE.Vector3(...origin) },
        resolution: { value: resolution },
        vehicle: { value: this.vehicle },
        lit: { value: this.lit },
        cut: this.cut,
      },
      vertexShader: VERTEX,
      fragmentShader: isSolid ? SOLID : AIRY,
    });
  }

  /** @param layer  'walls' or 'regions' */
  show(layer, on) {
    if (!(layer in this.shown)) return;
    this.shown[layer] = on;
    for (const mesh of this.group.children) if (mesh.name === layer) mesh.visible = on;
  }

  /** Hides walls above this height. @param z  m; null: shows all */
  cutAt(z) {
    this.cut.value = z ?? NO_CUT;
    for (const mesh of this.group.children) if (mesh.name === 'walls') mesh.material.side = this.side();
  }

  /** Inside faces are drawn only if walls are cut; otherwise one can look out from within a wall. */
  side() {
    return this.cut.value < NO_CUT ? THREE.DoubleSide : THREE.FrontSide;
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

  /** Returns the first face under a ray: {point, distance, layer}, or null. */
  hit(raycaster) {
    const hits = raycaster.intersectObjects(this.group.children.filter((mesh) => mesh.visible));
    const first = hits.find(({ object, point: at }) => object.name !== 'walls' || at.z <= this.cut.value);
    return first ? { point: first.point, distance: first.distance, layer: first.object.name } : null;
  }
}
