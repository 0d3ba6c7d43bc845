// Decides which messages of a channel are accepted: one sender at a time, each message once, none from the future.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/wire/header.h"
#include "core/wire/health.h"
#include "core/wire/message_losses.h"

namespace tern {

/// A message is refused if claimed_time() is farther than this ahead of the listener's clock. It is ten times the
/// permitted difference of clocks (docs/safety.md).
inline constexpr Duration kMaxAhead{100'000};
/// HEARTBEAT reports a problem of a channel (a second sender, messages from the future) until it has been absent this
/// long.
inline constexpr Duration kSenderTroubleReported{2'000'000};

/// How long the active sender of a channel must be silent before another one is accepted.
/// @return nullopt if several senders may publish at a time. These are channels without a Channel::silence
///   (messages/channels.h): GOAL, HEARTBEAT, CONFIGURATION, those of sensors. Unknown channels as well.
std::optional<Duration> sender_silence(std::string_view channel);

/// Judges the headers of one channel's messages in the order of their arrival. Pure.
///
/// On a channel with one sender at a time:
/// | event                                                 | effect                                  |
/// |-------------------------------------------------------|-----------------------------------------|
/// | first message                                         | its sender becomes the active one       |
/// | message of the active sender                          | judged by its sequence number           |
/// | message of another, active one silent for ≤ `silence` | refused; counted as a second sender     |
/// | message of another, active one silent for longer      | that sender becomes the active one      |
///
/// So a restarted process is accepted once the old one has been silent for `silence`. A second process started by
/// mistake has no effect, while it runs and when it ends (docs/decisions/one-sender-per-channel.md). Sequence numbers
/// are judged separately for each sender (SequenceWindow).
class SenderWatch {
 public:
  /// @param own_epoch_us  epoch of the listener, whose own messages come back to it
  explicit SenderWatch(std::optional<Duration> silence = {}, std::int64_t own_epoch_us = 0)
      : silence_(silence), own_epoch_us_(own_epoch_us) {}

  /// @param claimed claimed_time() of the message
  /// @param arrived  listener's clock
  /// @param own_sent  number of messages that the listener itself has sent on this channel
  /// @return the reason to refuse the message, or nullopt if it is accepted.
  std::optional<Rejection> judge(const MessageName& name, UTime claimed, UTime arrived, std::int64_t own_sent);

  /// Returns the number of messages of accepted senders that did not arrive.
  [[nodiscard]] std::int64_t lost() const { return losses_.lost(); }
  /// Whether a second sender has published several times, and recently.
  [[nodiscard]] bool has_second_sender(UTime now) const;
  /// Returns how far the newest message that was refused as Future was ahead of the listener's clock. nullopt with
  /// fewer than three of them, or once they have ceased for a while.
  [[nodiscard]] std::optional<Duration> ahead(UTime now) const;

 private:
  /// Counts an event that occurs repeatedly.
  struct Repetition {
    std::int64_t times = 0;
    UTime last;
    void add(UTime now);
    [[nodiscard]] bool lasts(UTime now) const;
  };
  [[nodiscard]] bool may_send(std::int64_t epoch_us, UTime now);

  std::optional<Duration> silence_;
  std::int64_t own_epoch_us_;
  MessageLosses losses_;
  std::int64_t active_ = 0, second_sender_ = 0;  ///< epochs; 0: none
  UTime active_at_;
  Repetition second_sender_messages_, future_;
  Duration ahead_{};
};

}  // namespace tern
