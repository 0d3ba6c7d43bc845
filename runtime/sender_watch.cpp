#include "runtime/sender_watch.h"

#include <algorithm>

#include "core/world/voxel_map.h"
#include "runtime/channels.h"

namespace tern {
namespace {

/// Senders whose sequence a channel remembers; the one not heard longest is forgotten first, so that forged epochs cost
/// no memory.
constexpr std::size_t kMaxSenders = 64;
/// What comes once or twice is noise, and not said.
constexpr std::int64_t kSeveral = 3;
/// A sender whose numbers begin again after so long a silence is a log that is played once more.
constexpr Duration kPlayedAgain{2'500'000};

constexpr Duration kSilence{1'000'000};
/// The planner calls predictions of this age stale: it cannot wait longer for a predictor that was started anew. Nor
/// can a vehicle in flight for a planner: plans are short.
constexpr Duration kShortSilence{300'000};

}  // namespace

std::optional<Duration> speaker_silence(std::string_view channel) {
  for (const char* one : {channels::kPredictions, channels::kPlan, channels::kPlanTiming, channels::kSearchView}) {
    if (channel == one) return kShortSilence;
  }
  if (channel == channels::kSemanticMap) return kMapSilence;
  for (const char* one : {channels::kUavState, channels::kSetpoint, channels::kDeclaredMotions,
                          channels::kHorizonRequest, channels::kObstacleTruth, channels::kFlightResult}) {
    if (channel == one) return kSilence;
  }
  return std::nullopt;
}

void SenderWatch::Repetition::add(UTime now) {
  if (now - last > kSenderTroubleSaid) times = 0;
  ++times;
  last = now;
}

bool SenderWatch::Repetition::lasts(UTime now) const { return times >= kSeveral && now - last <= kSenderTroubleSaid; }

std::optional<Rejection> SenderWatch::judge(const MessageName& name, UTime claimed, UTime arrived,
                                            std::int64_t own_sent) {
  ++count_;
  if (claimed > arrived + kMostAhead) {
    future_.add(arrived);
    ahead_ = claimed - arrived;
    return Rejection::Future;
  }
  const bool own = name.sender_epoch_us == own_epoch_us_;
  if (own && name.sequence > own_sent) return Rejection::Sender;
  if (!may_speak(name.sender_epoch_us, arrived)) return Rejection::Sender;
  Sender& sender = sender_of(name.sender_epoch_us);
  const bool played_again = arrived - sender.at > kPlayedAgain && name.sequence <= sender.window.newest();
  if (played_again) sender.window.begin_anew();
  const auto verdict = sender.window.add(name.sequence);
  if (verdict == SequenceWindow::Verdict::Repeated) return Rejection::Repeated;
  if (verdict == SequenceWindow::Verdict::Jump) return Rejection::Sender;
  sender.at = arrived;
  return std::nullopt;
}

bool SenderWatch::may_speak(std::int64_t epoch_us, UTime now) {
  if (!silence_) return true;
  if (epoch_us == speaker_ || speaker_ == 0 || now - speaker_at_ > *silence_) {
    speaker_ = epoch_us;
    speaker_at_ = now;
    return true;
  }
  if (epoch_us != rival_) rivalry_ = {};
  rival_ = epoch_us;
  rivalry_.add(now);
  return false;
}

SenderWatch::Sender& SenderWatch::sender_of(std::int64_t epoch_us) {
  Sender& sender = senders_[epoch_us];
  sender.heard = count_;
  if (senders_.size() > kMaxSenders) {
    const auto longest_ago = [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; };
    const auto forgotten = std::min_element(senders_.begin(), senders_.end(), longest_ago);
    lost_by_forgotten_ += forgotten->second.window.lost();
    senders_.erase(forgotten);
  }
  return sender;
}

std::int64_t SenderWatch::lost() const {
  std::int64_t lost = lost_by_forgotten_;
  for (const auto& [epoch_us, sender] : senders_) lost += sender.window.lost();
  return lost;
}

bool SenderWatch::has_rival(UTime now) const { return rivalry_.lasts(now); }

std::optional<Duration> SenderWatch::ahead(UTime now) const {
  if (!future_.lasts(now)) return std::nullopt;
  return ahead_;
}

}  // namespace tern
