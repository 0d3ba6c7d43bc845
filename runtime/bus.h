// The bus: typed publish and subscribe over LCM with a firewall, names, counters and pacing. The only owner of LCM in a process.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/world/health.h"
#include "messages/codec.h"
#include "runtime/clock.h"

namespace lcm {
class LCM;
}

namespace tern {

/// Batches of a set leave at least this far apart: LCM drops what does not fit the socket buffer.
inline constexpr Duration kPacing{2'000};

/// One process's end of the LCM network. Not thread-safe but for publish() (a planner's worker publishes its answer).
///
/// publish() fills in header.name and header.utime. subscribe() hands over only messages that decode exactly and pass
/// validation; the others are counted by reason and logged at most once a second, and change nothing. Gaps in a sender's
/// sequence numbers are counted as lost. Messages of this bus's own epoch are delivered too (LCM loops back).
class Bus {
 public:
  /// @param lcm  shared by all nodes of a process (memq:// delivers only within one instance)
  /// @param epoch_us  when the process started: the first half of every name it gives
  /// @param suffix  appended to every channel name ("" by default)
  Bus(std::shared_ptr<lcm::LCM> lcm, const Clock& clock, std::int64_t epoch_us, std::string suffix = "");
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Sends now. Returns the name that the message got.
  template <class T>
  MessageName publish(std::string_view channel, T message) {
    message.header = next_header(channel);
    send(channel, encode(message));
    return message.header.name;
  }

  /// Sends the first now and the others kPacing apart (by send_due, which the runner calls). Replaces what is still
  /// unsent of an earlier set on this channel, counted as dropped.
  template <class T>
  void publish_paced(std::string_view channel, std::vector<T> batches) {
    std::vector<Bytes> encoded;
    for (T& batch : batches) {
      batch.header = next_header(channel);
      encoded.push_back(encode(batch));
    }
    send_paced(channel, std::move(encoded));
  }

  template <class T>
  void subscribe(std::string_view channel, std::function<void(const T&)> handler) {
    subscribe_raw(channel, [this, handler = std::move(handler), name = std::string(channel)](std::span<const std::uint8_t> bytes) {
      auto message = decode<T>(bytes);
      if (!message) return reject(name, message.error());
      accept(name, message->header.name);
      handler(*message);
    });
  }

  [[nodiscard]] UTime next_due() const;  ///< when a paced message is due; kNever if none waits
  void send_due(UTime now);
  [[nodiscard]] const std::map<std::string, ChannelCounters>& counters() const;
  void count_late(std::string_view channel);  ///< a node found an accepted message too old to be used
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }

 private:
  Header next_header(std::string_view channel);
  void send(std::string_view channel, const Bytes& bytes);
  void send_paced(std::string_view channel, std::vector<Bytes> batches);
  void subscribe_raw(std::string_view channel, std::function<void(std::span<const std::uint8_t>)> handler);
  void reject(const std::string& channel, Rejection reason);
  void accept(const std::string& channel, MessageName name);

  const Clock& clock_;
  std::int64_t epoch_us_;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tern
