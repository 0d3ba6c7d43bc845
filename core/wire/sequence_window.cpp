#include "core/wire/sequence_window.h"

#include <algorithm>

namespace tern {
namespace {

constexpr std::uint64_t kAllSeen = ~std::uint64_t{0};
/// The largest gap that is counted, far above every real one, so that false sequence numbers cannot overflow the sum.
constexpr std::int64_t kMaxLost = 1'000'000'000;

}  // namespace

SequenceWindow::Verdict SequenceWindow::add(std::int64_t sequence) {
  smallest_ = smallest_ == 0 ? sequence : std::min(smallest_, sequence);
  const Verdict verdict = judge(sequence);
  if (verdict == Verdict::New) ++received_;
  return verdict;
}

SequenceWindow::Verdict SequenceWindow::judge(std::int64_t sequence) {
  if (now_.newest == 0) {
    now_.newest = sequence;
    now_.seen = kAllSeen;
    return Verdict::New;
  }
  if (former_ && sequence - former_->newest <= kShortGap && former_->newest - sequence < kRemembered) {
    if (has_come(*former_, sequence)) return Verdict::Repeated;
    now_ = *former_;
    former_.reset();
  }
  const std::int64_t ahead = sequence - now_.newest;
  if (ahead <= 0) return judge_near(-ahead);
  if (ahead <= kShortGap) {
    advance(ahead);
    return Verdict::New;
  }
  if (candidate_ == sequence) return Verdict::Repeated;
  if (candidate_ && sequence > *candidate_ && sequence - *candidate_ <= kShortGap) {
    continue_at(*candidate_, sequence);
    return Verdict::New;
  }
  candidate_ = sequence;
  return ahead <= kMaxGap ? Verdict::New : Verdict::Jump;
}

bool SequenceWindow::has_come(const Numbering& numbering, std::int64_t sequence) {
  const std::int64_t behind = numbering.newest - sequence;
  return 0 <= behind && behind < kRemembered && (numbering.seen >> behind & 1U) != 0;
}

SequenceWindow::Verdict SequenceWindow::judge_near(std::int64_t behind) {
  if (behind >= kRemembered || has_come(now_, now_.newest - behind)) return Verdict::Repeated;
  now_.seen |= std::uint64_t{1} << behind;
  --now_.lost;
  if (behind <= now_.gap) --now_.unsure;
  return Verdict::New;
}

void SequenceWindow::advance(std::int64_t ahead) {
  now_.newest += ahead;
  now_.seen = (now_.seen << ahead) | 1U;
  now_.gap = now_.unsure = ahead - 1;
  now_.lost += ahead - 1;
  candidate_.reset();
  if (former_ && ++continued_ >= kEstablished) former_.reset();
}

void SequenceWindow::restart() {
  now_ = {.lost = now_.lost - now_.unsure};
  candidate_.reset();
  former_.reset();
}

void SequenceWindow::continue_at(std::int64_t candidate, std::int64_t sequence) {
  if (!former_) former_ = now_;
  continued_ = 0;
  const std::int64_t missing = std::clamp<std::int64_t>(candidate - now_.newest - 1, 0, kMaxLost);
  now_ = {.newest = sequence, .seen = kAllSeen, .lost = now_.lost + missing + (sequence - candidate - 1)};
  candidate_.reset();
}

}  // namespace tern
