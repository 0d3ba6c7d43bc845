#include "core/wire/message_losses.h"

namespace tern {

SequenceWindow::Verdict MessageLosses::add(const MessageName& name, UTime arrived) {
  Sender& sender = senders_.touch(name.sender_epoch_us, [this](const Sender& forgotten) {
    lost_by_forgotten_ += forgotten.window.lost();
    before_forgotten_ += forgotten.window.before_first();
  });
  const bool played_again = arrived - sender.at > kReplaySilence && name.sequence <= sender.window.newest();
  if (played_again) sender.window.restart();
  const auto verdict = sender.window.add(name.sequence);
  if (verdict == SequenceWindow::Verdict::New) sender.at = arrived;
  return verdict;
}

std::int64_t MessageLosses::lost() const {
  std::int64_t lost = lost_by_forgotten_;
  senders_.for_each([&lost](const Sender& sender) { lost += sender.window.lost(); });
  return lost;
}

std::int64_t MessageLosses::before_first() const {
  std::int64_t before = before_forgotten_;
  senders_.for_each([&before](const Sender& sender) { before += sender.window.before_first(); });
  return before;
}

}  // namespace tern
