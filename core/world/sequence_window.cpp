#include "core/world/sequence_window.h"

#include <algorithm>

namespace tern {
namespace {

constexpr std::uint64_t kAllSeen = ~std::uint64_t{0};
/// A false sequence number shall not overflow the sum: no honest gap is as long.
constexpr std::int64_t kMostLost = 1'000'000'000;

}  // namespace

SequenceWindow::Verdict SequenceWindow::add(std::int64_t sequence) {
  const Verdict verdict = judge(sequence);
  if (verdict == Verdict::New) ++heard_;
  return verdict;
}

SequenceWindow::Verdict SequenceWindow::judge(std::int64_t sequence) {
  if (newest_ == 0) {
    newest_ = sequence;
    seen_ = kAllSeen;
    return Verdict::New;
  }
  const std::int64_t ahead = sequence - newest_;
  if (-kRemembered < ahead && ahead <= 0) return judge_near(-ahead);
  if (0 < ahead && ahead <= kShortGap) {
    lost_ += ahead - 1;
    newest_ = sequence;
    seen_ = (seen_ << ahead) | 1U;
    candidate_.reset();
    return Verdict::New;
  }
  if (candidate_ == sequence) return Verdict::Repeated;
  if (candidate_ && sequence > *candidate_ && sequence - *candidate_ <= kShortGap) {
    continue_at(*candidate_, sequence);
    return Verdict::New;
  }
  candidate_ = sequence;
  if (ahead < 0) return Verdict::Repeated;
  return ahead <= kLongestGap ? Verdict::New : Verdict::Jump;
}

SequenceWindow::Verdict SequenceWindow::judge_near(std::int64_t behind) {
  const std::uint64_t bit = std::uint64_t{1} << behind;
  if ((seen_ & bit) != 0) return Verdict::Repeated;
  seen_ |= bit;
  --lost_;
  return Verdict::New;
}

void SequenceWindow::begin_anew() {
  newest_ = 0;
  candidate_.reset();
  former_.reset();
}

void SequenceWindow::continue_at(std::int64_t candidate, std::int64_t sequence) {
  const bool goes_on = former_ && candidate > *former_ && candidate - *former_ <= kRemembered;
  const std::int64_t before = goes_on ? *former_ : newest_;
  if (goes_on) lost_ -= counted_;
  const std::int64_t missing = std::clamp<std::int64_t>(candidate - before - 1, 0, kMostLost);
  lost_ += missing + (sequence - candidate - 1);
  former_ = goes_on ? std::nullopt : std::optional(newest_);
  counted_ = missing;
  newest_ = sequence;
  seen_ = kAllSeen;
  candidate_.reset();
}

}  // namespace tern
