// Short texts over places of the scene.
import * as THREE from 'three';

/** Where a place of W is in the window, CSS pixels; null if it is out of view. @param at  three numbers */
export function placeInWindow(at, camera, { width, height }) {
  const seen = new THREE.Vector3(...at).project(camera);
  if (Math.max(Math.abs(seen.x), Math.abs(seen.y), Math.abs(seen.z)) > 1) return null;
  return { x: ((seen.x + 1) / 2) * width, y: ((1 - seen.y) / 2) * height };
}

export class Tags {
  /** @param root  gets an element per text */
  constructor(root) {
    this.root = root;
  }

  /** @param tags  {text, x, y}: shown just above that place, CSS pixels */
  show(tags) {
    const { children } = this.root;
    while (children.length > tags.length) this.root.lastChild.remove();
    while (children.length < tags.length) this.root.append(document.createElement('span'));
    tags.forEach(({ text, x, y }, k) => {
      const element = children[k];
      if (element.textContent !== text) element.textContent = text;
      element.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px) translate(-50%, -120%)`;
    });
  }
}
