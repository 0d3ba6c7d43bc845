// The number of lost messages of a channel. The bus, tern-logger and all readers of logs count by this class.
#pragma once

#include <cstdint>

#include "core/base/time.h"
#include "core/wire/header.h"
#include "core/wire/recent_senders.h"
#include "core/wire/sequence_window.h"

namespace tern {

/// Counts the lost messages of one channel from sequence numbers in the order of arrival.
///
/// Each sender has a SequenceWindow, which decides what is new and what is lost. If a sender's numbers start again
/// after a silence of kReplaySilence, a log is being played once more, and its window restarts.
class MessageLosses {
 public:
  static constexpr Duration kReplaySilence{2'500'000};

  /// Judges one message. @param arrived  when it arrived, by the receiver's clock
  SequenceWindow::Verdict add(const MessageName& name, UTime arrived);

  /// Returns the number of messages missing between those that arrived.
  [[nodiscard]] std::int64_t lost() const;
  /// Returns the number of messages sent before the first one that arrived. They are lost unless the receiver joined
  /// late.
  [[nodiscard]] std::int64_t before_first() const;

 private:
  struct Sender {
    SequenceWindow window;
    UTime at;  ///< when its last new message arrived
  };
  RecentSenders<std::int64_t, Sender> senders_;  ///< the key is the sender's epoch
  std::int64_t lost_by_forgotten_ = 0, before_forgotten_ = 0;
};

}  // namespace tern
