// The bus: typed publish and subscribe over LCM. It validates, numbers, counts and paces messages, and is the only
// owner of LCM in a process.
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

#include "core/wire/health.h"
#include "messages/codec.h"
#include "runtime/claimed_time.h"
#include "runtime/clock.h"
#include "runtime/keys.h"

namespace lcm {
class LCM;
}

namespace tern {

/// Shortest time between two batches of a set. A set sent at once could overflow the socket buffer, and LCM would drop
/// the rest.
inline constexpr Duration kPacing{2'000};

/// Capacity of LCM's queue for one subscription, messages. LCM drops the newest message if the queue is full. The queue
/// holds ten seconds at 100 Hz. After a shorter pause the process finds old messages, but no gap in their sequence.
inline constexpr int kQueueCapacity = 1'000;

/// The same for a listener to all channels, which may wait for a disk. The queue holds more than twenty seconds of a
/// flight.
inline constexpr int kListenCapacity = 50'000;

/// One process's end of the LCM network.
///
/// Outgoing: publish() fills in header.name and header.utime. With keys every message is signed (authentication.h).
///
/// Incoming: a message reaches a handler only if all of these hold. Otherwise it changes nothing; it is counted by
/// reason and logged at most once a second per channel.
///  1. With keys, its tag verifies. The tag is removed before decoding; without keys a trailer is ignored.
///  2. It decodes exactly and passes validation.
///  3. With keys, a HEARTBEAT or CONFIGURATION that names one of Tern's processes comes from that process's role.
///  4. Its sender is the one accepted on the channel, its number is new, its time is not in the future (SenderWatch).
///
/// A number missing in a sender's sequence counts as lost until its message arrives. The count begins with the first
/// message received from a sender's epoch, so late joining and restarts are no losses. LCM loops messages back:
/// handlers also receive the messages that this bus published.
///
/// Thread safety: only publish() and counters() may be called from any thread (a planner's worker publishes its
/// answer).
class Bus {
 public:
  /// @param lcm  shared by all nodes of a process (memq:// delivers only within one instance)
  /// @param epoch_us  when the process started, > 0: the first half of every message's name; no two buses may share it
  /// @param suffix  appended to every channel name ("" by default)
  /// @param keys  keys of the channels that this process publishes or receives; nullopt: messages are neither signed
  ///   nor verified
  /// @throws std::invalid_argument if the suffix is not is_channel_name.
  Bus(std::shared_ptr<lcm::LCM> lcm, const Clock& clock, std::int64_t epoch_us, std::string suffix = "",
      std::optional<KeyRing> keys = {});
  /// Unsubscribes. @pre not called from a handler
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// True for a legal channel name or suffix: letters, digits, '_' and '-', at most 63 of them, or the empty text. (LCM
  /// reads other characters as a pattern.)
  static bool is_channel_name(std::string_view name);

  /// Sends the message immediately and returns its name. Thread-safe: messages leave in the order of their sequence
  /// numbers.
  /// @throws std::invalid_argument if the message breaks its contract (see encode), or if there is no key for
  ///   this channel. A message that throws uses up no sequence number.
  template <class T>
  MessageName publish(const Channel<T>& channel, std::type_identity_t<T> message) {
    return send(channel.name, [&message](const Header& header) {
      message.header = header;
      return encode(message);
    });
  }

  /// Sends the first batch immediately and the others kPacing apart, by send_due(), which the runner calls. Unsent
  /// batches of an earlier set on this channel are dropped and counted in unsent(). A batch gets its name and time when
  /// it is sent.
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
  /// order of their subscription, and the message is counted once. An exception of a handler is kept for rethrow(),
  /// because it must not unwind through LCM.
  /// @throws std::invalid_argument if there are keys but none for this channel.
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

  /// Receives every message of every channel as it arrived: with its trailer, unchecked and uncounted, as a recorder
  /// needs it. `received_us` is when the kernel took it from the network, µs since the Unix epoch. Channel names are
  /// those on the wire, with their suffixes.
  using Listener =
      std::function<void(std::string_view wire_name, std::int64_t received_us, std::span<const std::uint8_t> bytes)>;
  /// Installs the listener; there is at most one. LCM's queue for it holds kListenCapacity messages.
  void listen(Listener listener);
  [[nodiscard]] bool listens() const;  ///< whether a listener is installed

  [[nodiscard]] UTime next_due() const;  ///< when a paced message is due; kNever if none waits
  void send_due(UTime now);              ///< sends the messages that are due, at most one per channel
  /// Returns a copy of the counters, by channel name without suffix. Thread-safe.
  [[nodiscard]] std::map<std::string, ChannelCounters> counters() const;
  /// Counts an accepted message that a node found too old to be used.
  template <class T>
  void count_late(const Channel<T>& channel) {
    count_late_on(channel.name);
  }
  /// Counts an accepted message as refused by the node for a reason of its own, and logs that like any refusal.
  template <class T>
  void refuse(const Channel<T>& channel, Rejection reason) {
    refuse_on(channel.name, reason);
  }
  [[nodiscard]] std::int64_t unsent() const;      ///< paced messages replaced by a newer set before they were sent
  [[nodiscard]] std::int64_t deliveries() const;  ///< delivered messages, also refused ones; with keys: verified ones

  /// The time, by this bus's clock, at which the kernel took the message being delivered from the network. The handler
  /// may run much later.
  /// @pre called from a handler
  [[nodiscard]] UTime received() const;
  /// Throws the exception that a handler threw since the last call, if any. No messages are delivered until then.
  /// Runners call it after each drain.
  void rethrow();
  /// Recent problems with senders, as text for HEARTBEAT: a second sender beside the accepted one, or a clock that is
  /// far ahead. Empty if there are none.
  [[nodiscard]] std::string sender_troubles() const;
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] std::int64_t epoch_us() const { return epoch_us_; }
  [[nodiscard]] const std::string& suffix() const;  ///< appended to the channels' names on the wire

 private:
  using Encoder = std::function<Bytes(const Header&)>;
  using RawHandler = std::function<void(std::span<const std::uint8_t>)>;
  struct ChannelState;
  struct State;
  MessageName send(std::string_view channel, const Encoder& encoder);
  void send_paced(std::string_view channel, std::vector<Encoder> batches);
  void subscribe_raw(std::string_view channel, RawHandler handler);
  void reject(const std::string& channel, Rejection reason);
  bool admits(const std::string& channel, const MessageName& name, UTime claimed);
  void count_late_on(std::string_view channel);
  void refuse_on(std::string_view channel, Rejection reason);
  void count_refused(ChannelState& channel, Rejection reason);
  /// Whether the sender of the message being delivered may use this process name.
  [[nodiscard]] bool may_report_as(std::string_view process) const;

  const Clock& clock_;
  std::int64_t epoch_us_;
  std::unique_ptr<State> state_;
};

}  // namespace tern
