#include "tools/audit/measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "tools/audit/audit.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

constexpr double kNear = 1.0;    // m
constexpr double kStep = 0.001;  ///< s; the width of the bounds is quadratic in it
/// Most steps of one span. After a long gap the bounds are wide in any case.
constexpr double kMaxSteps = 10'000.0;

/// Chords between positions that an estimator has measured. Along a straight way, errors at the joints cancel. Errors
/// across it lengthen a chord L to at most √(L² + e²). So chords are long, and shortened by that. At the ends of the
/// way, errors along it remain, of e at most.
constexpr double kMeasuredChord = 1.0;  ///< least length, m
constexpr double kMeasuredError = 0.1;  ///< e, the largest difference of the errors at both ends, m

/// Whether the recorded positions are exact: those of the simulator's own vehicle.
bool has_exact_states(const FlightRecord& record) {
  if (record.states.empty() || record.results.empty()) return false;
  const std::int64_t referee = record.results.back().header.name.sender_epoch_us;
  return record.states.front().header.name.sender_epoch_us == referee;
}

/// A time step of the flight, so short that the motion is nearly straight.
struct Step {
  double from_s = 0.0, to_s = 0.0;      ///< in the window
  Vec3 middle;                          ///< W
  double chord_m = 0.0, net_m = 0.0;    ///< lower and upper bound of the true path's length
  double slowest = 0.0, fastest = 0.0;  ///< bounds of the true |v|, m/s
  double best_speed = 0.0;              ///< of the curve, in the middle
  double stray_m = 0.0;                 ///< greatest distance of the truth from the middle
  bool surely = true;                   ///< the flight surely contains the whole step
  [[nodiscard]] double seconds() const { return to_s - from_s; }
};

/// Bounds |v| over [a, b]: v is quadratic, so it lies in the hull of three points.
void bound_speed(const MotionSpan& span, double a, double b, Step& step) {
  const Vec3 v0 = span.curve.v(a);
  const Vec3 v1 = span.curve.v(b);
  const Vec3 net[] = {v0, v0 + 0.5 * (b - a) * span.curve.a(a), v1};
  const Vec3 v = span.curve.v(0.5 * (a + b));
  const double speed = v.norm();
  double along = std::numeric_limits<double>::infinity();
  for (const Vec3& q : net) {
    step.fastest = std::max(step.fastest, q.norm() + span.speed_error);
    along = std::min(along, speed > 0.0 ? q.dot(v) / speed : 0.0);
  }
  step.slowest = std::max(0.0, along - span.speed_error);
  step.best_speed = speed;
}

Step step_of(const MotionSpan& span, double a, double b) {
  Step step;
  const Eigen::Matrix<double, 3, 4> points = bernstein_points(span.curve, a, b);
  step.middle = span.curve.p(0.5 * (a + b));
  for (int k = 0; k < 3; ++k) step.net_m += (points.col(k + 1) - points.col(k)).norm();
  step.net_m += span.wander_m * (b - a) / span.curve.length_s();
  // The curve may differ from the truth, so its length is no lower bound of the true path's.
  if (span.wander_m == 0.0) step.chord_m = (points.col(3) - points.col(0)).norm();
  step.stray_m = (points.colwise() - step.middle).colwise().norm().maxCoeff() + span.error.norm();
  bound_speed(span, a, b, step);
  return step;
}

class Measuring {
 public:
  Measuring(const FlightRecord& record, const Window& window)
      : record_(record), window_(window), exact_(has_exact_states(record)) {
    for (const Region& region : record.regions) measures_.regions.emplace_back().region = region.name;
  }

  void take(const MotionSpan& span) {
    const double begin = (span.curve.from - window_.from).seconds();
    const double a = std::max(0.0, -begin);
    const double b = std::min(span.curve.length_s(), (window_.to - span.curve.from).seconds());
    if (a >= b) return;
    const int count = std::max(1, static_cast<int>(std::min(kMaxSteps, std::ceil((b - a) / kStep))));
    for (int i = 0; i < count; ++i) {
      const double from = a + (b - a) * i / count;
      const double to = a + (b - a) * (i + 1) / count;
      Step step = step_of(span, from, to);
      step.from_s = begin + from;
      step.to_s = begin + to;
      step.surely = step.from_s >= window_.unsure.seconds() && step.to_s <= sure_to_s();
      take(step);
    }
    const bool surely = begin >= window_.unsure.seconds() && begin + span.curve.length_s() <= sure_to_s();
    if (span.wander_m > 0.0 && surely) {
      take_chord(span);
    } else {
      chord_from_.reset();
    }
  }

  Measures finish() {
    if (steps_.empty()) {
      measures_.unseen_s = (window_.to - window_.from).seconds();
    } else {
      // Before the first request the vehicle is stationary.
      const Duration late = begins_at_rest() ? Duration{} : record_.states.front().at - window_.from;
      const Duration early = window_.to - record_.states.back().at;
      measures_.unseen_s = (std::max(late, Duration{}) + std::max(early, Duration{})).seconds();
    }
    measures_.path_m.low = std::max(measures_.path_m.low, 0.0);
    widen();
    measures_.top_speed.low = surely_looked_at();
    return std::move(measures_);
  }

 private:
  /// Adds the chord from the last joint to the end of this span, if it is long enough.
  void take_chord(const MotionSpan& span) {
    if (!chord_from_) {
      chord_from_ = span.curve.p(0.0);
      if (!exact_) measures_.path_m.low -= kMeasuredError;
    }
    const Vec3 end = span.curve.p(span.curve.length_s());
    const double chord = (end - *chord_from_).norm();
    if (!exact_ && chord < kMeasuredChord) return;
    measures_.path_m.low += exact_ ? chord : std::sqrt(chord * chord - kMeasuredError * kMeasuredError);
    chord_from_ = end;
  }
  [[nodiscard]] double sure_to_s() const { return (window_.sure_to() - window_.from).seconds(); }
  [[nodiscard]] bool begins_at_rest() const {
    return !record_.requests.empty() && record_.requests.front().id == 1 &&
           record_.states.front().at <= record_.requests.front().t_s && record_.states.front().motion.v.isZero();
  }

  void take(const Step& step) {
    measures_.path_m.low += step.surely ? step.chord_m : 0.0;
    measures_.path_m.high += step.net_m;
    measures_.path_m.best += step.best_speed * step.seconds();
    measures_.top_speed.high = std::max(measures_.top_speed.high, step.fastest);
    measures_.top_speed.best = std::max(measures_.top_speed.best, step.best_speed);
    for (std::size_t k = 0; k < measures_.regions.size(); ++k) {
      RegionMeasure& r = measures_.regions[k];
      const double distance = distance_to(record_.regions[k], step.middle);
      add(step, distance, r.seconds, r.metres, r.border);
      add(step, distance - kNear, r.near_seconds, r.near_metres, r.near_border);
    }
    steps_.push_back(step);
  }

  /// Adds a step at a signed distance from a border.
  void add(const Step& step, double distance, Between& seconds, Between& metres, Border& border) {
    if (distance <= 0.0) {
      seconds.best += step.seconds();
      metres.best += step.best_speed * step.seconds();
    }
    if (distance <= step.stray_m) {
      seconds.high += step.seconds();
      metres.high += step.net_m;
    }
    if (distance <= -step.stray_m && step.surely) {
      seconds.low += step.seconds();
      metres.low += step.chord_m;
    }
    const bool open = std::abs(distance) < step.stray_m;
    border.crossings += open && !border.open ? 1 : 0;
    border.open = open;
  }

  /// Adds time without a state: the vehicle may have flown anywhere, at its top speed.
  void widen() {
    if (measures_.unseen_s == 0.0) return;
    const double speed = record_.requests.empty() ? std::numeric_limits<double>::infinity()
                                                  : record_.requests.front().limits.v_max.norm();
    const double metres = speed * measures_.unseen_s;
    measures_.path_m.high += metres;
    measures_.top_speed.high = std::max(measures_.top_speed.high, speed);
    for (RegionMeasure& r : measures_.regions) {
      for (Between* s : {&r.seconds, &r.near_seconds}) s->high += measures_.unseen_s;
      for (Between* m : {&r.metres, &r.near_metres}) m->high += metres;
    }
  }

  /// Returns the greatest speed that is surely held for kRefereeLook.
  [[nodiscard]] double surely_looked_at() const {
    double most = 0.0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      double slowest = steps_[i].slowest;
      std::size_t k = i;
      while (steps_[k].to_s < steps_[i].from_s + kRefereeLook && k + 1 < steps_.size()) {
        slowest = std::min(slowest, steps_[++k].slowest);
      }
      const bool whole = steps_[k].to_s >= steps_[i].from_s + kRefereeLook && steps_[i].surely && steps_[k].surely;
      if (whole) most = std::max(most, slowest);
    }
    return most;
  }

  const FlightRecord& record_;
  Window window_;
  bool exact_;  ///< the recorded positions
  Measures measures_;
  std::vector<Step> steps_;
  std::optional<Vec3> chord_from_;  ///< where the next chord begins, m, W
};

}  // namespace

Measures measure(const FlightRecord& record) {
  Measuring measuring(record, judged_window(record));
  for (const MotionSpan& span : vehicle_motion(record).spans) measuring.take(span);
  return measuring.finish();
}

}  // namespace tern::audit
