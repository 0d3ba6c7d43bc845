// The connection to tern-viewer: frames in, commands out. It reconnects by itself.

const FIRST_RETRY_MS = 250;
const LAST_RETRY_MS = 2000;

/**
 * Calls handlers.frame(frame) for every frame, handlers.reply(message) for answers to this page's commands,
 * handlers.open() and handlers.close(), and handlers.malformed(text, error) for a malformed frame.
 *
 * A frame is {frame: n, dropped: k, ...topics}. The page acknowledges a drawn frame by `seen`, and the bridge sends at most
 * two frames ahead. A slow page gets fewer frames, never older ones.
 */
export class Stream {
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.retryMs = FIRST_RETRY_MS;
    this.unseen = 0;
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(this.url);
    this.socket.onopen = () => {
      this.retryMs = FIRST_RETRY_MS;
      this.unseen = 0;
      this.handlers.open();
    };
    this.socket.onmessage = (event) => this.take(event.data);
    this.socket.onclose = () => {
      this.handlers.close();
      setTimeout(() => this.connect(), this.retryMs);
      this.retryMs = Math.min(2 * this.retryMs, LAST_RETRY_MS);
    };
  }

  take(text) {
    try {
      const message = JSON.parse(text);
      if (message === null || typeof message !== 'object') throw new TypeError('not an object');
      if (Number.isInteger(message.frame)) {
        this.unseen = message.frame;
        this.handlers.frame(message);
      } else {
        this.handlers.reply(message);
      }
    } catch (error) {
      this.handlers.malformed(String(text), error);
    }
  }

  /** Acknowledges the drawn frame. */
  drawn() {
    if (this.unseen === 0) return;
    this.send({ seen: this.unseen });
    this.unseen = 0;
  }

  send(command) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }
}
