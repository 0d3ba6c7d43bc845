// Who is heard on a channel: one sender at a time, each message once, nothing from the future.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/world/header.h"
#include "core/world/health.h"
#include "core/world/message_losses.h"

namespace tern {

/// No message may claim a time farther ahead of the listener's clock: ten times what clocks may differ
/// (docs/safety.md).
inline constexpr Duration kMaxAhead{100'000};
/// HEARTBEAT reports a channel's troubles (a second sender, messages from the future) until they have not happened for
/// so long.
inline constexpr Duration kSenderTroubleReported{2'000'000};

/// How long the sender that is heard on a channel must be silent before another one is heard.
/// @return nullopt if any number may speak at a time: OBSTACLE_OBSERVATIONS, GOAL, HEARTBEAT, CONFIGURATION, and
/// channels that Tern does not know.
std::optional<Duration> sender_silence(std::string_view channel);

/// Judges the headers of one channel's messages in the order of their arrival. Pure.
///
/// On a channel with one speaker, the sender that was heard first stays the speaker until it has been silent for
/// `silence`. Then whoever speaks next is. So a restarted process is heard as soon as the dead one has been silent for
/// that long. One that runs beside it by mistake changes nothing, neither while it lives nor when it ends
/// (docs/decisions/who-is-heard.md). Sequence numbers are judged by sender (SequenceWindow).
class SenderWatch {
 public:
  /// @param own_epoch_us  of the listener's own messages, which come back to it
  explicit SenderWatch(std::optional<Duration> silence = {}, std::int64_t own_epoch_us = 0)
      : silence_(silence), own_epoch_us_(own_epoch_us) {}

  /// @return why a message is refused, or nullopt if it is to be handed on.
  /// @param claimed  the newest time that the message says has been (claimed_time)   @param arrived  listener's clock
  /// @param own_sent  how many messages the listener itself has sent on this channel
  std::optional<Rejection> judge(const MessageName& name, UTime claimed, UTime arrived, std::int64_t own_sent);

  /// Messages that every sender that was heard has sent and that did not come.
  [[nodiscard]] std::int64_t lost() const { return losses_.lost(); }
  /// Whether another sender than the speaker has spoken several times, and lately.
  [[nodiscard]] bool has_second_sender(UTime now) const;
  /// How far ahead of the listener's clock messages were stamped, if several were lately.
  [[nodiscard]] std::optional<Duration> ahead(UTime now) const;

 private:
  /// Something that happens again and again.
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
