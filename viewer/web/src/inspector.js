// Shows the messages of the picked object.

const REFRESH_MS = 400;

function cell(tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  return element;
}

function words(value) {
  if (Array.isArray(value)) return value.map((x) => (x === '' ? '–' : words(x))).join(', '); // a class without a name
  if (value !== null && typeof value === 'object') {
    return Object.entries(value).map(([key, x]) => `${key} ${words(x)}`).join(';  ');
  }
  return String(value);
}

function fields(message) {
  const list = document.createElement('dl');
  for (const [key, value] of Object.entries(message)) {
    if (key === 'channel') continue;
    if (key === 'yaml') {
      list.append(cell('pre', value));
    } else if (Array.isArray(value) && typeof value[0] === 'object') {
      value.forEach((entry, k) => list.append(cell('dt', `${key}[${k}]`), cell('dd', words(entry))));
    } else if (value !== null && typeof value === 'object' && !Array.isArray(value)) {
      for (const [name, x] of Object.entries(value)) list.append(cell('dt', name), cell('dd', words(x)));
    } else {
      list.append(cell('dt', key), cell('dd', words(value)));
    }
  }
  return list;
}

export class Inspector {
  /** @param ask  sends a command to the bridge */
  constructor(ask) {
    this.ask = ask;
    this.panel = document.getElementById('inspector');
    this.pick = null;
    document.getElementById('closeinspector').onclick = () => this.close();
    setInterval(() => this.refresh(), REFRESH_MS);
  }

  /** @param words  returns a sentence about the picked object from its detail, or nothing */
  open(pick, words = null) {
    this.pick = pick;
    this.words = words;
    document.getElementById('messages').replaceChildren();
    this.refresh();
  }

  /** Lists events; a click jumps to one. @param events  {t, text}  @param words  about events that are not listed */
  list(title, events, jump, words) {
    this.pick = this.words = null;
    this.say(title, words);
    const rows = events.map(({ t, text }) => {
      const row = cell('button', `${t.toFixed(1)} s  ${text}`);
      row.className = 'event';
      row.onclick = () => jump(t);
      return row;
    });
    document.getElementById('messages').replaceChildren(...(rows.length ? rows : [cell('p', 'nothing yet')]));
  }

  say(title, words) {
    document.getElementById('inspected').textContent = title;
    document.getElementById('words').textContent = words;
    this.panel.hidden = false;
  }

  close() {
    this.pick = null;
    this.panel.hidden = true;
    this.closed?.();
  }

  refresh() {
    if (this.pick) this.ask({ pick: this.pick });
  }

  show(detail) {
    if (!this.pick) return;
    const scroll = this.panel.scrollTop;
    this.say(detail.title, this.words?.(detail) ?? '');
    const parts = detail.messages.flatMap((message) => [cell('h3', message.channel), fields(message)]);
    document.getElementById('messages').replaceChildren(...(parts.length ? parts : [cell('p', detail.note ?? 'no message about it was received')]));
    this.panel.scrollTop = scroll;
  }
}
