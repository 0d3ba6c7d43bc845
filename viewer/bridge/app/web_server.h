// Serves the page and streams the board to every browser. The only place that knows HTTP and WebSocket (Boost.Beast).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "viewer/bridge/access.h"
#include "viewer/bridge/app/page_files.h"
#include "viewer/bridge/board.h"

namespace tern {

/// Beyond these, browsers are refused (503) and connections closed.
inline constexpr int kMaxStreams = 16;
inline constexpr int kMaxConnections = 64;
/// A page tells which frame it has drawn, {"seen": n}. It gets no more than this many ahead, so that nothing piles up
/// in any buffer. What comes meanwhile waits on the board, where only the newest counts.
inline constexpr int kFramesAhead = 2;
/// What a page may say at once, bytes, and how many of its commands wait to be read.
inline constexpr std::size_t kMaxCommandBytes = 4096;
inline constexpr std::size_t kMaxCommands = 64;

/// What a page said.
struct ClientCommand {
  std::int64_t client = 0;
  std::string text;
};

struct WebCounters {
  std::int64_t frames = 0;            ///< sent
  std::int64_t dropped = 0;           ///< texts that some page was too slow for
  std::int64_t refused = 0;           ///< requests: a foreign Host or Origin, an unknown path or method, too many
  std::int64_t commands_dropped = 0;  ///< a page talked faster than it is listened to
};

/// Runs in a thread of its own; every function may be called from any thread, and none waits for a browser.
class WebServer {
 public:
  /// @param listening_fd  a listening TCP socket; taken over
  /// @param board  outlives this
  /// @throws std::system_error when the socket cannot be used.
  WebServer(int listening_fd, PageFiles files, Access access, const Board& board);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// The board has news.
  void wake();
  /// To one page, a JSON text besides the frames; at most kMaxCommands wait, then the oldest goes.
  void reply(std::int64_t client, std::string json);
  /// What pages have said since the last call, in order.
  std::vector<ClientCommand> take_commands();
  /// Pages that look, by number: a number is given once.
  [[nodiscard]] std::vector<std::int64_t> clients() const;
  [[nodiscard]] WebCounters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tern
