// The inside of Estimator: the order of its inputs in time, and the phases.
#pragma once

#include <deque>
#include <optional>

#include "estimator/estimator.h"
#include "estimator/filter/msckf.h"
#include "estimator/filter/position_fix.h"
#include "estimator/filter/rest.h"
#include "estimator/filter/track_table.h"

namespace tern {

/// Means of the IMU from one time to another.
struct TimedStep {
  UTime from, to;
  ImuStep step;
};

/// The filter moved on to the newest sample, without the clones.
struct AheadState {
  NavState nav;
  NavMatrix P = NavMatrix::Zero();
  NavMatrix Phi = NavMatrix::Identity();  ///< the error's transition since the filter's time

  void move(const ImuStep& step, const EstimatorConfig& config);
};

struct Estimator::State {
  State(const EstimatorConfig& configuration, const RestPlace& at_rest)
      : config(configuration), place(at_rest), rest(configuration.noise, configuration.gravity) {}

  InputOutcome add(const ImuSample& sample, const ImuRange& range);
  InputOutcome add(const FeatureFrame& frame, const Masks& masks);
  InputOutcome add(const PositionFix& fix);
  void begin(const NavState& state, const NavMatrix& P, UTime at);
  [[nodiscard]] std::optional<Estimate> estimate() const;

  EstimatorConfig config;
  RestPlace place;
  EstimatorStatus status;

  // Everything below serves the functions above.
  InputOutcome refuse(Trouble trouble);
  InputOutcome refuse_order(const ImuSample& sample);
  void note(Trouble trouble);
  [[nodiscard]] ImuStep step_of(const ImuSample& sample, const ImuRange& range);
  void rest_on(const TimedStep& step);
  void move_on(const TimedStep& step);
  void process();
  bool process_frames();
  bool process_fixes();
  bool believe(const PositionFix& fix);
  bool follow();
  void advance(UTime to);
  void use(const FeatureFrame& frame, const Masks& masks);
  void move_ahead();
  void thin_clones();
  void judge(const UpdateCounts& counts);
  [[nodiscard]] std::size_t anchors() const;

  RestMeter rest;
  std::deque<TimedStep> imu;  // from the filter's time, or the end of the rest's mean, to the newest sample
  std::optional<ImuSample> newest;
  std::optional<UTime> out_of_order;  // the newest sample that was refused for its time, since the last used one
  Duration passed_out_of_order;       // the time that these samples span
  std::optional<Msckf> filter;
  UTime filter_at;
  AheadState ahead;
  OdometryOffset T_WO;

  struct WaitingFrame {
    FeatureFrame frame;
    Masks masks;
  };
  std::deque<WaitingFrame> frames;
  std::deque<PositionFix> fixes;
  RefusedFixes refused_fixes;
  std::optional<FeatureFrame> last_frame;
  int same_images = 0;

  TrackTable tracks;
  std::int64_t number = 0;        // of the newest clone
  std::int64_t first_active = 0;  // clones with a lower number are anchors: they have no views
  UTime seen_at, used_at;         // when a frame had features, when some were used
  int tracked = 0;
  UpdateCounts counts;
  double decayed_used = 0.0, decayed_refused = 0.0;
};

}  // namespace tern
