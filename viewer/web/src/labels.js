// Readable names of fields.

const UNITS = { mps3: 'm/s³', mps2: 'm/s²', mps: 'm/s', ms: 'ms', s: 's', m: 'm', us: 'µs', rad: 'rad', kb: 'kB' };

/** "UAV_STATE.speed_mps" as a caption: "speed m/s". */
export function label(name) {
  const [table, field] = [name.slice(0, name.indexOf('.')), name.slice(name.indexOf('.') + 1)];
  const [, base, unit, component = ''] = /^(.*?)(?:_([a-z0-9]+))?(\.[xyz])?$/.exec(field);
  const words = (UNITS[unit] ? `${base}${component} ${UNITS[unit]}` : field).replaceAll('_', ' ');
  if (table === 'clearance') return `to ${words}`;
  return table === 'UAV_STATE' || table === 'PLAN_TIMING' ? words : `${table.toLowerCase().replaceAll('_', ' ')} ${words}`;
}
