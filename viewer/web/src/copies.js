// Many copies of a shape in one geometry. Without a GPU an instance would cost as much as a mesh.
import * as THREE from 'three';

/** @param shape  has an index; its normals are left out, since the copies are not lit again */
export function repeated(shape, count) {
  const vertices = shape.attributes.position.count;
  const { array: corners } = shape.index;
  const geometry = new THREE.BufferGeometry();
  const index = new Uint32Array(count * corners.length);
  for (let k = 0; k < index.length; ++k) index[k] = corners[k % corners.length] + vertices * Math.floor(k / corners.length);
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  for (const [name, { array, itemSize }] of Object.entries(shape.attributes)) {
    if (name === 'normal') continue;
    const all = new Float32Array(count * array.length);
    for (let k = 0; k < count; ++k) all.set(array, k * array.length);
    geometry.setAttribute(name, new THREE.BufferAttribute(all, itemSize).setUsage(THREE.DynamicDrawUsage));
  }
  return geometry;
}

/** Tells the renderer that the first `count` vertices have changed. */
export function touch(attribute, count) {
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, count * attribute.itemSize);
  attribute.needsUpdate = true;
}
