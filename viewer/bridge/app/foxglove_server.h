// Serves Foxglove's WebSocket protocol (viewer/foxglove/protocol.h) by Boost.Beast.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "viewer/bridge/access.h"
#include "viewer/foxglove/protocol.h"

namespace tern {

/// The limits of the server: clients, messages of clients that wait to be read, and bytes that wait for one client. A
/// client that reads too slowly loses its oldest messages, but the newest of each latched channel reaches it.
inline constexpr int kMaxFoxgloveClients = 16;
inline constexpr std::size_t kMaxFoxgloveInbox = 64;
inline constexpr std::size_t kMaxFoxgloveBacklog = 8 << 20;

/// A message that a client published, and the channel that it had advertised.
struct FoxglovePublished {
  std::int64_t client = 0;
  foxglove::ClientAdvertise::Entry channel;
  std::vector<std::uint8_t> payload;
};

/// Counts since the start.
struct FoxgloveCounters {
  std::int64_t sent = 0;     ///< messages
  std::int64_t dropped = 0;  ///< messages that a slow client missed
  std::int64_t refused = 0;  ///< connections, texts and published messages
};

/// Runs a thread of its own. Every function may be called from any thread; none waits for a client.
class FoxgloveServer {
 public:
  /// @param listening_fd  a listening TCP socket; the server closes it
  /// @param origins  pages of these origins may connect; programs send no Origin, and may connect too
  /// @throws boost::system::system_error if the socket cannot be used
  FoxgloveServer(int listening_fd, Access access, std::vector<std::string> origins,
                 std::vector<foxglove::Channel> channels, std::string session);
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  /// Returns true if a client subscribes to the channel, or if its newest message is wanted for clients to come.
  [[nodiscard]] bool is_wanted(std::size_t channel) const;
  /// Sends a message to the channel's subscribers.
  void publish(std::size_t channel, UTime at, std::string cdr);
  /// Sends a text to a client, if it is still there.
  void tell(std::int64_t client, foxglove::Level level, const std::string& message);
  /// Returns the messages received since the last call, in order.
  std::vector<FoxglovePublished> take_published();
  [[nodiscard]] FoxgloveCounters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tern
