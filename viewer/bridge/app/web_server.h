// Serves the page and streams the board to every browser. All HTTP and WebSocket code (Boost.Beast) is here.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "viewer/bridge/access.h"
#include "viewer/bridge/app/page_files.h"
#include "viewer/bridge/board.h"

namespace tern {

/// Limits of concurrent streams and connections. A further stream gets 503; a further connection is closed.
inline constexpr int kMaxStreams = 16;
inline constexpr int kMaxConnections = 64;
/// Most frames sent but not yet drawn. A page acknowledges a drawn frame with {"seen": n}, so no buffer fills up. In
/// the meantime new texts replace older ones on the board.
inline constexpr int kFramesAhead = 2;
/// Limits of one command, bytes, and of commands that wait to be read.
inline constexpr std::size_t kMaxCommandBytes = 4096;
inline constexpr std::size_t kMaxCommands = 64;

/// A command as a page sent it.
struct ClientCommand {
  std::int64_t client = 0;
  std::string text;
};

/// Counts since the start.
struct WebCounters {
  std::int64_t frames = 0;   ///< sent
  std::int64_t dropped = 0;  ///< texts that a slow page missed
  std::int64_t refused =
      0;  ///< requests with a foreign Host or Origin or an unknown path or method, or beyond kMaxStreams
  std::int64_t commands_dropped = 0;  ///< commands beyond kMaxCommands
};

/// Runs a thread of its own. Every function may be called from any thread; none waits for a browser.
class WebServer {
 public:
  /// @param listening_fd  a listening TCP socket; the server closes it
  /// @param board  outlives the server
  /// @throws boost::system::system_error if the socket cannot be used
  WebServer(int listening_fd, PageFiles files, Access access, const Board& board);
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// Tells the server that the board has new texts.
  void wake();
  /// Sends a JSON text to one page, outside the frames. At most kMaxCommands wait; then the oldest is dropped.
  void reply(std::int64_t client, std::string json);
  /// Returns the commands received since the last call, in order.
  std::vector<ClientCommand> take_commands();
  /// Returns the numbers of the connected pages. A number is never used twice.
  [[nodiscard]] std::vector<std::int64_t> clients() const;
  [[nodiscard]] WebCounters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tern
