// How many messages of a channel were lost: the one count of the bus, of tern-logger and of those who read logs.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/world/header.h"
#include "core/world/recent_senders.h"
#include "core/world/sequence_window.h"

namespace tern {

/// The sequence numbers of one channel, by sender, in the order of arrival. Pure. SequenceWindow says what is new and
/// what is lost. A sender whose numbers begin again after kReplaySilence of silence is a log that is played once more.
class MessageLosses {
 public:
  static constexpr Duration kReplaySilence{2'500'000};

  /// @param arrived  listener's clock
  SequenceWindow::Verdict add(const MessageName& name, UTime arrived);

  /// Messages that the senders sent between those that came.
  [[nodiscard]] std::int64_t lost() const;
  /// Messages that they sent before the first that came: lost, unless the listener joined late.
  [[nodiscard]] std::int64_t before_first() const;

 private:
  struct Sender {
    SequenceWindow window;
    UTime at;  ///< when its last new message came
  };
  RecentSenders<std::int64_t, Sender> senders_;  ///< by epoch
  std::int64_t lost_by_forgotten_ = 0, before_forgotten_ = 0;
};

}  // namespace tern
