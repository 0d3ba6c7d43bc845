// Checks of received data before use: malformed data must not reach the drawing.

/** Three finite numbers. */
export function point(x) {
  return numbers(x, 3, 1);
}

/** A flat list of finite numbers, `width` per row; exactly `rows` rows if given. */
export function numbers(list, width, rows) {
  if (!Array.isArray(list) || list.length % width !== 0) throw new RangeError(`not rows of ${width} numbers`);
  if (rows !== undefined && list.length !== width * rows) throw new RangeError(`not ${rows} rows of ${width} numbers`);
  if (!list.every(Number.isFinite)) throw new RangeError('not numbers');
  return list;
}
