// The panels: the vehicle, the last answer, every process.

const SILENT_S = 2.5; // processes publish twice a second
const ENDED_S = 6; // after this silence a process counts as ended
/** Faster changes could not be read. */
const READ_MS = 100;

const byId = (id) => document.getElementById(id);
const fixed = (x, digits = 1, unit = '') => (Number.isFinite(x) ? `${x.toFixed(digits)}${unit && ` ${unit}`}` : '–');

/** Skips equal texts: the browser would lay out and paint each of them again. */
export function say(id, text) {
  const element = byId(id);
  if (element.textContent !== text) element.textContent = text;
}

function chip(id, text, kind) {
  say(id, text);
  const element = byId(id);
  if (element.className !== `chip ${kind}`) element.className = `chip ${kind}`;
}

export function showSession(session) {
  chip('mode', session.mode, session.mode);
  say('name', session.name.split('/').slice(-2).join('/'));
  byId('name').title = session.name;
  document.body.classList.toggle('recorded', session.mode !== 'live');
  for (const id of ['goalmode', 'hold-goal', 'stop-goal']) {
    byId(id).disabled = !session.goals;
    byId(id).parentElement.title = session.goals ? '' : 'read-only: tern-viewer runs without --allow-goals';
  }
}

/** Clears the panels, for another flight. */
export function forget() {
  waiting.clear();
  for (const name of Object.keys(shown)) delete shown[name];
}

/** Shows that the bridge is lost. */
export function showGone() {
  chip('mode', 'bridge lost', 'gone');
  for (const item of byId('health').children) item.className = 'unknown';
}

const waiting = new Map(); // topic → newest value that is not shown yet
const shown = {}; // values of the panels, by the charts' field names
let shownAt = -Infinity;

/** Returns the values of the panels, by the charts' field names. */
export const numbers = () => shown;

/** Makes the next draw() show everything. */
export function hurry() {
  shownAt = -Infinity;
}

/** Shows the newest values, all at once, at a readable rate. @param now  ms @return true if it drew */
export function draw(now) {
  if (now - shownAt < READ_MS) return false;
  for (const show of waiting.values()) show();
  waiting.clear();
  shownAt = now;
  return true;
}

export function takeState(state, goal) {
  waiting.set('state', () => showState(state, goal));
}

export function takePlan(plan) {
  waiting.set('plan', () => showPlan(plan));
}

export function takeTiming(timing) {
  waiting.set('timing', () => showTiming(timing));
}

function showState(state, goal) {
  const speed = Math.hypot(...state.v);
  const acceleration = Math.hypot(...state.a);
  Object.assign(shown, {
    'UAV_STATE.speed_mps': speed,
    'UAV_STATE.total_acceleration_mps2': acceleration,
    'clearance.obstacles_m': state.clearance,
    'clearance.map_m': state.map_clearance,
  });
  ['x', 'y', 'z'].forEach((axis, k) => (shown[`UAV_STATE.position_m.${axis}`] = state.p[k]));
  say('speed', fixed(speed));
  say('acceleration', fixed(acceleration, 1, 'm/s²'));
  say('clearance', fixed(state.clearance, 2, 'm'));
  document.body.classList.toggle('nomap', !Number.isFinite(state.map_clearance));
  say('mapclearance', fixed(state.map_clearance, 2, 'm'));
  say('position', state.p.map((x) => fixed(x)).join('  '));
  say('togoal', goal?.p ? fixed(Math.hypot(...state.p.map((x, k) => goal.p[k] - x)), 1, 'm') : '–');
}

function showPlan(plan) {
  shown['PLAN.hold_s'] = plan?.hold_s;
  shown['PLAN.confidence'] = plan?.confidence;
  say('confidence', confidenceOf(plan));
  if (!plan) {
    chip('outcome', 'no plan yet', '');
    say('reason', '');
    return say('hold', '–');
  }
  chip('outcome', plan.outcome, plan.outcome.split(' ')[0]);
  say('reason', (plan.reason === 'none' ? '' : plan.reason) + (plan.relaxed ? ' relaxed' : ''));
  say('hold', fixed(plan.hold_s, 2, 's'));
}

/** Confidence as text. 1: nothing is estimated. 0 or relaxed: certified for a part of the predictions, confidence unknown. */
function confidenceOf(plan) {
  if (!plan || plan.outcome === 'no plan') return '–';
  if (plan.confidence === 0 || plan.relaxed) return 'none known';
  return `${plan.confidence}${plan.sure_for_s === undefined ? '' : ` for ${fixed(plan.sure_for_s, 1, 's')}`}`;
}

/** @param timing  null: no answer yet; both times are by the system's clock */
function showTiming(timing) {
  for (const field of ['total_ms', 'allowed_ms', 'expansions', 'hulls']) shown[`PLAN_TIMING.${field}`] = timing?.[field];
  const meter = byId('meter');
  if (!timing) {
    meter.style.width = 0;
    say('replan', '–');
    return say('work', '–');
  }
  const { total_ms, allowed_ms, expansions, hulls } = timing;
  say('replan', fixed(total_ms) + (allowed_ms > 0 ? ` of ${fixed(allowed_ms, 0)} ms` : ' ms'));
  say('work', `${expansions} · ${hulls}`);
  const share = allowed_ms > 0 ? total_ms / allowed_ms : 0;
  meter.style.width = `${Math.min(100 * share, 100)}%`;
  meter.className = timing.late || timing.watchdog ? 'late' : '';
}

export function showResult(result) {
  if (!result) return;
  waiting.delete('plan'); // its last answer is outdated
  chip('outcome', result.outcome, result.outcome === 'reached' ? 'live' : 'bad');
  const least = [['obstacles', result.min_clearance_m], ['map', result.min_map_clearance_m]].filter(([, x]) => Number.isFinite(x));
  const words = least.map(([what, x]) => `${fixed(x, 3)} m to ${what}`).join(', ');
  say('reason', `${fixed(result.flight_time_s)} s, ${fixed(result.path_length_m, 0)} m${words && `; least ${words}`}`);
}

/** Shows the sentence on what held the vehicle. @param why  empty: none @param isOver  the flight has ended, or its log */
export function showWhy(why, isOver) {
  say('why', isOver && why ? why : '');
}

export function showClock(seconds) {
  say('clock', `${fixed(Math.round(10 * seconds) / 10)} s`); // avoids -0.0
}

/** @param pick  called with the name of a clicked process */
export function showHealth(processes, pick) {
  byId('health').replaceChildren(
    ...processes.map((process) => {
      const item = document.createElement('li');
      item.className = stateOf(process);
      item.textContent = process.name.replace(/^tern-/, '');
      const note = document.createElement('span');
      note.className = 'dim';
      note.textContent = process.waiting_for || trouble(process);
      item.title = `${process.state}; ${process.received} received, ${process.refused} refused, ${process.lost} lost`;
      item.append(note);
      item.onclick = () => pick(process.name);
      return item;
    }),
  );
}

function stateOf({ state, age_s }) {
  if (state === 'finished' || age_s > ENDED_S) return 'ended';
  return age_s > SILENT_S ? 'silent' : state;
}

function trouble({ state, age_s, refused, lost }) {
  if (stateOf({ state, age_s }) === 'ended') return 'ended';
  if (age_s > SILENT_S) return `silent ${age_s.toFixed(0)} s`;
  if (refused > 0) return `${refused} refused`;
  return lost > 0 ? `${lost} lost` : '';
}

let toastTimer = 0;
export function toast(text) {
  const element = byId('toast');
  element.textContent = text;
  element.className = 'shown';
  clearTimeout(toastTimer);
  toastTimer = setTimeout(() => (element.className = ''), 3500);
}
