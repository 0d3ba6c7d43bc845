#include "runtime/sender_watch.h"

#include "messages/channels.h"

namespace tern {
namespace {

/// Events that occur once or twice are noise and are not reported.
constexpr std::int64_t kSeveral = 3;

}  // namespace

std::optional<Duration> sender_silence(std::string_view channel) {
  std::optional<Duration> silence;
  visit_channel(channel, [&silence](const auto& known) { silence = known.silence; });
  return silence;
}

void SenderWatch::Repetition::add(UTime now) {
  if (now - last > kSenderTroubleReported) times = 0;
  ++times;
  last = now;
}

bool SenderWatch::Repetition::lasts(UTime now) const {
  return times >= kSeveral && now - last <= kSenderTroubleReported;
}

std::optional<Rejection> SenderWatch::judge(const MessageName& name, UTime claimed, UTime arrived,
                                            std::int64_t own_sent) {
  if (claimed > arrived + kMaxAhead) {
    future_.add(arrived);
    ahead_ = claimed - arrived;
    return Rejection::Future;
  }
  const bool own = name.sender_epoch_us == own_epoch_us_;
  if (own && name.sequence > own_sent) return Rejection::Sender;
  if (!may_send(name.sender_epoch_us, arrived)) return Rejection::Sender;
  const auto verdict = losses_.add(name, arrived);
  if (verdict == SequenceWindow::Verdict::Repeated) return Rejection::Repeated;
  if (verdict == SequenceWindow::Verdict::Jump) return Rejection::Sender;
  return std::nullopt;
}

bool SenderWatch::may_send(std::int64_t epoch_us, UTime now) {
  if (!silence_) return true;
  if (epoch_us == active_ || active_ == 0 || now - active_at_ > *silence_) {
    active_ = epoch_us;
    active_at_ = now;
    return true;
  }
  if (epoch_us != second_sender_) second_sender_messages_ = {};
  second_sender_ = epoch_us;
  second_sender_messages_.add(now);
  return false;
}

bool SenderWatch::has_second_sender(UTime now) const { return second_sender_messages_.lasts(now); }

std::optional<Duration> SenderWatch::ahead(UTime now) const {
  if (!future_.lasts(now)) return std::nullopt;
  return ahead_;
}

}  // namespace tern
