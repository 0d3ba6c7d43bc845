// A link to a moment: #t=6.3&cam=top, cam=fit for the whole flight, or cam=free:x,y,z,x,y,z with the camera's position and
// its target.

export const MODES = ['chase', 'first', 'top', 'side', 'free'];

/** @return {t, cam, eye}: seconds of the flight, a mode or fit, six numbers; missing or wrong parts are left out */
export function readLink(hash) {
  const parameters = new URLSearchParams(hash.replace(/^#/, ''));
  const link = {};
  const t = Number(parameters.get('t'));
  if (parameters.has('t') && Number.isFinite(t)) link.t = t;
  const [mode, place] = (parameters.get('cam') ?? '').split(':');
  if (!MODES.includes(mode) && mode !== 'fit') return link;
  link.cam = mode;
  const eye = (place ?? '').split(',').map(Number);
  if (mode === 'free' && place && eye.length === 6 && eye.every(Number.isFinite)) link.eye = eye;
  return link;
}

/** @param link  as returned by readLink */
export function writeLink({ t, cam, eye }) {
  const parts = [];
  if (t !== undefined) parts.push(`t=${Number(t.toFixed(2))}`);
  if (cam) parts.push(`cam=${cam}${eye ? `:${eye.map((x) => Number(x.toFixed(2))).join(',')}` : ''}`);
  return parts.length ? `#${parts.join('&')}` : '';
}
