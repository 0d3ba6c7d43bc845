// Estimator: each input is checked, and takes its way through the phases.
#include <algorithm>

#include "estimator/estimator_state.h"
#include "estimator/filter/input_check.h"

namespace tern {
namespace {

/// Samples that come later than this after the one before it are missing some: IMUs in use send at 100 Hz or faster.
constexpr Duration kGap{30'000};
/// Standard deviations of the motion that a gap or a saturated sample hides, as a share of the range.
constexpr double kGapRate = 0.5, kGapForce = 3.0;  ///< rad/s, m/s²
constexpr double kHiddenShare = 0.25;
constexpr std::size_t kMostWaiting = 100;
/// Images that are the same in turn, before the camera is called stuck.
constexpr int kSameImages = 2;

}  // namespace

void Estimator::State::note(Trouble trouble) {
  ++status.count[idx(trouble)];
  if (newest) status.last[idx(trouble)] = newest->at;
}

InputOutcome Estimator::State::refuse(Trouble trouble) {
  note(trouble);
  return InputOutcome::Refused;
}

/// When the IMU's clock steps back, its samples are refused until it has caught up. The motion of this time is unknown,
/// and no gap shows between the samples that are used.
InputOutcome Estimator::State::refuse_order(const ImuSample& sample) {
  if (out_of_order && sample.at > *out_of_order) {
    passed_out_of_order = passed_out_of_order + (sample.at - *out_of_order);
  }
  out_of_order = sample.at;
  if (status.phase == EstimatorPhase::Moving && passed_out_of_order > kMaxImuGap) status.phase = EstimatorPhase::Lost;
  return refuse(Trouble::ImuOrder);
}

void Estimator::State::begin(const NavState& state, const NavMatrix& P, UTime at) {
  status.phase = EstimatorPhase::Moving;
  filter.emplace(state, P);
  filter_at = seen_at = used_at = at;
  move_ahead();
}

ImuStep Estimator::State::step_of(const ImuSample& sample, const ImuRange& range) {
  ImuStep step{sample.angular_velocity, sample.specific_force, (sample.at - newest->at).seconds()};
  if (sample.at - newest->at > kGap) {
    note(Trouble::ImuGap);
    // The sample says nothing about the time before it.
    step.rate = 0.5 * (sample.angular_velocity + newest->angular_velocity);
    step.force = 0.5 * (sample.specific_force + newest->specific_force);
    step.extra_rate = kGapRate;
    step.extra_force = kGapForce;
  }
  const bool rate_ends = range.rate > 0.0 && sample.angular_velocity.cwiseAbs().maxCoeff() >= range.rate;
  const bool force_ends = range.force > 0.0 && sample.specific_force.cwiseAbs().maxCoeff() >= range.force;
  if (rate_ends || force_ends) note(Trouble::ImuSaturated);
  if (rate_ends) step.extra_rate = std::max(step.extra_rate, kHiddenShare * range.rate);
  if (force_ends) step.extra_force = std::max(step.extra_force, kHiddenShare * range.force);
  return step;
}

InputOutcome Estimator::State::add(const ImuSample& sample, const ImuRange& range) {
  if (!is_usable(sample)) return refuse(Trouble::ImuNotFinite);
  if (newest && sample.at <= newest->at) return refuse_order(sample);
  if (status.phase == EstimatorPhase::Lost) return InputOutcome::Refused;
  out_of_order.reset();
  passed_out_of_order = {};
  if (status.phase == EstimatorPhase::Moving && !newest) {
    // start() gave the state at a time; the first sample after it stands for the time since then.
    if (sample.at <= filter_at) return refuse(Trouble::ImuOrder);
    newest = ImuSample{filter_at, sample.angular_velocity, sample.specific_force};
  }
  if (!newest) {
    newest = sample;
    return InputOutcome::Used;
  }
  const TimedStep step{newest->at, sample.at, step_of(sample, range)};
  newest = sample;
  if (status.phase == EstimatorPhase::Moving) {
    move_on(step);
  } else {
    rest_on(step);
  }
  return InputOutcome::Used;
}

void Estimator::State::rest_on(const TimedStep& step) {
  imu.push_back(step);
  if (!rest.add(step.step, step.to)) {
    if (status.phase == EstimatorPhase::AtRest) {
      const auto [state, P] = state_at_rest(rest.mean(), config, place);
      begin(state, P, rest.end());
      process();
      return;
    }
    note(Trouble::NotAtRest);
    rest.restart();
  }
  const double duration = rest.mean().duration;
  if (duration >= config.rest_s - 1e-9) status.phase = EstimatorPhase::AtRest;
  const UTime keep_from = duration > 0.0 ? rest.end() : newest->at - kMaxDelay;
  while (!imu.empty() && imu.front().to <= keep_from) imu.pop_front();
  while (!frames.empty() && frames.front().frame.at < keep_from) frames.pop_front();
  while (!fixes.empty() && fixes.front().at < keep_from) fixes.pop_front();
}

void Estimator::State::move_on(const TimedStep& step) {
  if (step.to - step.from > kMaxImuGap) {
    status.phase = EstimatorPhase::Lost;
    return;
  }
  imu.push_back(step);
  ahead.move(step.step, config);
  process();
}

InputOutcome Estimator::State::add(const FeatureFrame& given, const Masks& masks) {
  CheckedFrame checked_frame = checked(given);
  for (const Trouble trouble : checked_frame.troubles) note(trouble);
  if (checked_frame.refused || status.phase == EstimatorPhase::Lost) return InputOutcome::Refused;
  if (!newest || given.at > newest->at + kMaxAhead || frames.size() >= kMostWaiting) return refuse(Trouble::FrameAhead);
  const bool is_late = status.phase == EstimatorPhase::Moving && given.at < filter_at;
  if (is_late || (last_frame && given.at <= last_frame->at)) return refuse(Trouble::FrameLate);
  same_images = last_frame && is_same_image(*last_frame, checked_frame.frame) ? same_images + 1 : 0;
  last_frame = checked_frame.frame;
  if (same_images >= kSameImages && status.phase == EstimatorPhase::Moving) return refuse(Trouble::CameraStuck);
  frames.push_back({std::move(checked_frame.frame), masks});
  if (status.phase == EstimatorPhase::Moving) process();
  return InputOutcome::Used;
}

InputOutcome Estimator::State::add(const PositionFix& fix) {
  if (!is_usable(fix)) return refuse(Trouble::FixNotFinite);
  if (status.phase == EstimatorPhase::Lost) return InputOutcome::Refused;
  if (!newest || fix.at > newest->at + kMaxAhead || fixes.size() >= kMostWaiting) return refuse(Trouble::FixAhead);
  const auto later = std::upper_bound(fixes.begin(), fixes.end(), fix.at,
                                      [](UTime at, const PositionFix& other) { return at < other.at; });
  fixes.insert(later, fix);
  if (status.phase == EstimatorPhase::Moving) process();
  return InputOutcome::Used;
}

}  // namespace tern
