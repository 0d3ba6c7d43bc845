// Estimator: what waited for the IMU corrects the filter, in the order of time.
#include "estimator/estimator_state.h"
#include "estimator/filter/continuity.h"
#include "estimator/filter/position_fix.h"

namespace tern {
namespace {

/// Clones that left the window stay as anchors, this far apart, for as long as the drift over 1 s needs them.
constexpr Duration kAnchorSpacing{250'000}, kAnchorAge{1'200'000};
constexpr double kLostDeviation = 1e3;  ///< m: a position that is known worse is of no use
/// When the filter follows the IMU without frames, it moves this far at a time.
constexpr Duration kFollowStep{50'000};
/// Sums of used and refused features decay by this per frame; from kLeastJudged features on, this share is too much.
constexpr double kDecay = 0.9, kLeastJudged = 20.0, kContradicting = 0.65;

}  // namespace

void AheadState::move(const ImuStep& step, const EstimatorConfig& config) {
  ImuStep half = step;
  half.h *= 0.5;
  const ErrorTransition change = error_transition(moved(nav, half, config.gravity), step, config.noise, config.gravity);
  nav = moved(nav, step, config.gravity);
  P = (change.Phi * P * change.Phi.transpose() + change.Q).eval();
  Phi = (change.Phi * Phi).eval();
}

void Estimator::State::move_ahead() {
  ahead = {filter->nav(), filter->nav_covariance(), NavMatrix::Identity()};
  for (const TimedStep& step : imu) ahead.move(step.step, config);
}

void Estimator::State::process() {
  const PoseInW before{ahead.nav.R, ahead.nav.p};
  const bool by_frames = process_frames();
  const bool by_fixes = process_fixes();
  const bool by_time = follow();
  if (!by_frames && !by_fixes && !by_time) return;
  move_ahead();
  const NavMatrix J = ordinary_error_jacobian(ahead.nav);
  const double variance = (J * ahead.P * J.transpose()).block<3, 3>(kErrorP, kErrorP).trace();
  if (!filter->is_finite() || !(variance < kLostDeviation * kLostDeviation)) {
    status.phase = EstimatorPhase::Lost;
    return;
  }
  T_WO = after_correction(T_WO, before, {ahead.nav.R, ahead.nav.p}, config.max_step, config.max_turn);
}

bool Estimator::State::process_frames() {
  bool changed = false;
  while (!frames.empty() && frames.front().frame.at <= newest->at) {
    const WaitingFrame waiting = std::move(frames.front());
    frames.pop_front();
    if (waiting.frame.at < filter_at) {
      note(Trouble::FrameLate);
      continue;
    }
    advance(waiting.frame.at);
    use(waiting.frame, waiting.masks);
    changed = true;
  }
  return changed;
}

bool Estimator::State::process_fixes() {
  bool changed = false;
  while (!fixes.empty()) {
    const PositionFix fix = fixes.front();
    // A frame that is still on its way may be older than the fix.
    if (fix.at > filter_at && newest->at - fix.at < kMaxDelay) break;
    fixes.pop_front();
    if (fix.at > filter_at) advance(fix.at);
    switch (use_fix(*filter, filter_at, fix)) {
      case FixOutcome::Used:
        refused_fixes.clear();
        changed = true;
        break;
      case FixOutcome::TooOld: note(Trouble::FixLate); break;
      case FixOutcome::Contradicts:
        note(Trouble::FixContradicts);
        changed = believe(fix) || changed;
        break;
    }
  }
  return changed;
}

bool Estimator::State::believe(const PositionFix& fix) {
  const auto offset = fix_offset(*filter, filter_at, fix);
  if (!offset || !refused_fixes.add(fix, *offset)) return false;
  refused_fixes.clear();
  widen_by(*offset, *filter);
  use_fix(*filter, filter_at, fix);
  return true;
}

bool Estimator::State::follow() {
  if (newest->at - filter_at <= kMaxDelay + kFollowStep) return false;
  advance(newest->at - kMaxDelay);
  FeatureFrame nothing_seen;
  nothing_seen.at = filter_at;
  use(nothing_seen, {});
  return true;
}

void Estimator::State::advance(UTime to) {
  while (!imu.empty() && imu.front().from < to) {
    TimedStep& front = imu.front();
    if (front.to <= to) {
      filter->propagate(front.step, config.noise, config.gravity);
      imu.pop_front();
      continue;
    }
    ImuStep part = front.step;
    part.h = (to - front.from).seconds();
    filter->propagate(part, config.noise, config.gravity);
    front.step.h = (front.to - to).seconds();
    front.from = to;
  }
  filter_at = to;
}

void Estimator::State::use(const FeatureFrame& frame, const Masks& masks) {
  filter->add_clone(++number, frame.at);
  const FeatureFrame seen = unmasked(frame, masks, PoseInW{filter->nav().R, filter->nav().p});
  const int slips = tracks.add(seen, *filter);
  tracked = static_cast<int>(seen.features.size());
  if (tracked > 0) seen_at = frame.at;
  const std::size_t first = anchors();
  counts = filter->use(tracks.take(filter->clones(), first, config.clones, config.features_per_update), first);
  counts.refused += slips;
  if (counts.used > 0) used_at = frame.at;
  judge(counts);
  thin_clones();
}

std::size_t Estimator::State::anchors() const {
  std::size_t count = 0;
  while (filter->clones()[count].number < first_active) ++count;
  return count;
}

void Estimator::State::thin_clones() {
  const std::size_t first = anchors();
  if (filter->clones().size() - first >= idx(config.clones)) {
    const Clone& oldest = filter->clones()[first];
    tracks.forget(oldest.number);
    first_active = oldest.number + 1;
    const bool is_anchor = first == 0 || oldest.at - filter->clones()[first - 1].at >= kAnchorSpacing;
    if (!is_anchor) filter->remove_clone(first);
  }
  while (filter->clones().front().number < first_active && filter_at - filter->clones().front().at > kAnchorAge) {
    filter->remove_clone(0);
  }
}

void Estimator::State::judge(const UpdateCounts& of_frame) {
  decayed_used = kDecay * decayed_used + of_frame.used;
  decayed_refused = kDecay * decayed_refused + of_frame.refused;
  const double all = decayed_used + decayed_refused;
  if (of_frame.refused > 0 && all >= kLeastJudged && decayed_refused > kContradicting * all) {
    note(Trouble::TracksContradict);
  }
}

}  // namespace tern
