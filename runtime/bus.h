// The bus: typed publish and subscribe over LCM with a firewall, names, counters and pacing. The only owner of LCM in a
// process.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/world/health.h"
#include "messages/codec.h"
#include "runtime/claimed_time.h"
#include "runtime/clock.h"
#include "runtime/keys.h"

namespace lcm {
class LCM;
}

namespace tern {

/// Batches of a set leave at least this far apart: LCM drops what does not fit the socket buffer.
inline constexpr Duration kPacing{2'000};

/// What LCM may hold of one subscription until the process comes to read it; then it drops the newest. Ten seconds at
/// 100 Hz: a process that was stopped for a moment finds no gap in a state's sequence, only old messages.
inline constexpr int kQueueCapacity = 1'000;

/// The same for a listener to all channels, which may wait for a disk: over twenty seconds of a flight.
inline constexpr int kListenCapacity = 50'000;

/// One process's end of the LCM network. Not thread-safe but for publish() and counters() (a planner's worker publishes
/// its answer).
///
/// publish() fills in header.name and header.utime. subscribe() hands over only messages that decode exactly and pass
/// validation. They must come from who is heard on the channel, once and not from the future (SenderWatch). The others
/// change nothing; they are counted by reason and logged at most once a second per channel. Gaps in a sender's sequence
/// numbers count as lost until what is missing comes. The first message heard of a sender epoch begins its count, so
/// neither a late joiner nor a sender's restart is loss. Messages of this bus's own epoch are delivered too (LCM loops
/// back).
///
/// With keys every message that leaves is signed, and only what verifies comes in (authentication.h); the tag is off
/// before anything is decoded. A HEARTBEAT or CONFIGURATION that names one of Tern's processes must come from that
/// one's role. Without keys a trailer is passed over unread.
class Bus {
 public:
  /// @param lcm  shared by all nodes of a process (memq:// delivers only within one instance)
  /// @param epoch_us  when the process started, > 0: the first half of every name it gives; no two buses may share it
  /// @param suffix  appended to every channel name ("" by default)
  /// @param keys  what this end may say and hear; nullopt: nobody's messages are signed or checked
  /// @throws std::invalid_argument if the suffix is not is_channel_name.
  Bus(std::shared_ptr<lcm::LCM> lcm, const Clock& clock, std::int64_t epoch_us, std::string suffix = "",
      std::optional<KeyRing> keys = {});
  /// Unsubscribes. @pre not called from a handler
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Whether a channel name or suffix is one that LCM takes literally: letters, digits, '_' and '-', at most 63 (it may
  /// be empty).
  static bool is_channel_name(std::string_view name);

  /// Sends now. Returns the name that the message got. Thread-safe: sequence numbers leave in order.
  /// @throws std::invalid_argument when the message breaks its contract (see encode), or there are keys but none for
  /// this channel; nothing was sent, no number used.
  template <class T>
  MessageName publish(const Channel<T>& channel, std::type_identity_t<T> message) {
    return send(channel.name, [&message](const Header& header) {
      message.header = header;
      return encode(message);
    });
  }

  /// Sends the first now and the others kPacing apart (by send_due, which the runner calls). Replaces what is still
  /// unsent of an earlier set on this channel, counted in unsent(). Names and times are given when a batch leaves.
  template <class T>
  void publish_paced(const Channel<T>& channel, std::type_identity_t<std::vector<T>> batches) {
    std::vector<Encoder> encoders;
    for (T& batch : batches) {
      encoders.push_back([message = std::move(batch)](const Header& header) mutable {
        message.header = header;
        return encode(message);
      });
    }
    send_paced(channel.name, std::move(encoders));
  }

  /// Calls `handler` with every accepted message of the channel. Several handlers of one channel are called in the
  /// order of their subscription, and the message is counted once. What a handler throws is kept for rethrow(): nothing
  /// may unwind through LCM.
  /// @throws std::invalid_argument when there are keys but none for this channel.
  template <class T>
  void subscribe(const Channel<T>& channel, std::type_identity_t<std::function<void(const T&)>> handler) {
    subscribe_raw(channel.name, [this, handler = std::move(handler),
                                 name = std::string(channel.name)](std::span<const std::uint8_t> bytes) {
      auto message = decode<T>(bytes);
      if (!message) return reject(name, message.error());
      if constexpr (requires { message->process; }) {
        if (!may_report_as(message->process)) return reject(name, Rejection::Unauthenticated);
      }
      if (admits(name, message->header.name, claimed_time(*message))) handler(*message);
    });
  }

  /// Hands over every message of every channel as it came, trailer included, unchecked and uncounted: what a recorder
  /// needs. `received_us` is when the kernel took it from the network, µs since the Unix epoch. Channel names are the
  /// wire's, with their suffixes.
  using Listener =
      std::function<void(std::string_view wire_name, std::int64_t received_us, std::span<const std::uint8_t> bytes)>;
  /// One listener at most; kListenCapacity messages wait for it in LCM's queue at most.
  void listen(Listener listener);

  [[nodiscard]] UTime next_due() const;  ///< when a paced message is due; kNever if none waits
  void send_due(UTime now);              ///< sends what is due, at most one message per channel
  /// A copy, by channel name without suffix. Thread-safe.
  [[nodiscard]] std::map<std::string, ChannelCounters> counters() const;
  /// A node found an accepted message too old to be used.
  template <class T>
  void count_late(const Channel<T>& channel) {
    count_late_on(channel.name);
  }
  [[nodiscard]] std::int64_t unsent() const;      ///< paced messages that a newer set replaced before they left
  [[nodiscard]] std::int64_t deliveries() const;  ///< messages that came in, accepted or not; with keys: that verified
  /// When the kernel took the newest delivered message from the network, by this bus's clock. A handler may run much
  /// later.
  /// @pre called from a handler
  [[nodiscard]] UTime received() const;
  /// Throws what a handler threw, if one did since the last call. Deliveries stop until then. Runners call it after a
  /// drain.
  void rethrow();
  /// Troubles of senders heard lately, as text for HEARTBEAT: a second one beside the one that is heard, a clock that
  /// is far ahead. Empty when there is none.
  [[nodiscard]] std::string sender_troubles() const;
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }
  [[nodiscard]] const std::string& suffix() const;  ///< of its channels' names on the wire

 private:
  using Encoder = std::function<Bytes(const Header&)>;
  using RawHandler = std::function<void(std::span<const std::uint8_t>)>;
  struct Line;
  struct State;
  MessageName send(std::string_view channel, const Encoder& encoder);
  void send_paced(std::string_view channel, std::vector<Encoder> batches);
  void subscribe_raw(std::string_view channel, RawHandler handler);
  void reject(const std::string& channel, Rejection reason);
  bool admits(const std::string& channel, const MessageName& name, UTime claimed);
  void count_late_on(std::string_view channel);
  void count_refused(Line& line, Rejection reason);
  /// Whether who sent the message being delivered may give this as its process's name.
  [[nodiscard]] bool may_report_as(std::string_view process) const;

  const Clock& clock_;
  std::int64_t epoch_us_;
  std::unique_ptr<State> state_;
};

}  // namespace tern
