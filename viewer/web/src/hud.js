// Numbers and words: the vehicle, the last answer, every process.

const SILENT_S = 2.5; // processes say something twice a second

const byId = (id) => document.getElementById(id);
const fixed = (x, digits = 1) => (Number.isFinite(x) ? x.toFixed(digits) : '–');

function chip(element, text, kind) {
  element.textContent = text;
  element.className = `chip ${kind}`;
}

export function showSession(session) {
  chip(byId('mode'), session.mode, session.mode);
  byId('name').textContent = session.name.split('/').slice(-2).join('/');
  byId('name').title = session.name;
  const button = byId('goalmode');
  button.disabled = !session.goals;
  button.title = session.goals ? 'then click on the ground (g)' : 'read-only: tern-viewer runs without --allow-goals';
}

export function showGone() {
  chip(byId('mode'), 'bridge gone', 'gone');
}

export function showState(state, goal) {
  byId('speed').textContent = fixed(Math.hypot(...state.v));
  byId('acceleration').textContent = fixed(Math.hypot(...state.a));
  byId('clearance').textContent = fixed(state.clearance, 2);
  byId('position').textContent = state.p.map((x) => fixed(x)).join('  ');
  byId('togoal').textContent = goal ? fixed(Math.hypot(...state.p.map((x, k) => goal.p[k] - x))) : '–';
}

export function showPlan(plan) {
  chip(byId('outcome'), plan.outcome, plan.outcome.split(' ')[0]);
  byId('reason').textContent = plan.reason + (plan.relaxed ? ' relaxed' : '');
  byId('hold').textContent = fixed(plan.hold_s, 2);
}

export function showTiming(timing) {
  const { total_ms, allowed_ms } = timing;
  byId('replan').textContent = fixed(total_ms) + (allowed_ms > 0 ? ` of ${fixed(allowed_ms, 0)} ms` : ' ms');
  byId('work').textContent = `${timing.expansions} · ${timing.hulls}`;
  const meter = byId('meter');
  const share = allowed_ms > 0 ? total_ms / allowed_ms : 0;
  meter.style.width = `${Math.min(100 * share, 100)}%`;
  meter.className = share > 1 || timing.watchdog ? 'late' : '';
}

export function showResult(result) {
  if (!result) return;
  chip(byId('outcome'), result.outcome, result.outcome === 'reached' ? 'live' : 'bad');
  byId('reason').textContent = `${fixed(result.flight_time_s)} s, ${fixed(result.path_length_m, 0)} m`;
}

export function showClock(seconds) {
  byId('clock').textContent = `${seconds.toFixed(1)} s`;
}

/** @param pick  is called with the name of a process that was clicked */
export function showHealth(processes, pick) {
  byId('health').replaceChildren(
    ...processes.map((process) => {
      const item = document.createElement('li');
      item.className = process.age_s > SILENT_S ? 'silent' : process.state;
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

function trouble({ age_s, refused, lost }) {
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
