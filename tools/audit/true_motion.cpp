#include "tools/audit/true_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tools/audit/commitment.h"

namespace tern::audit {
namespace {

/// A slower vehicle may return to the same place: two equal states do not show that it stayed, m/s.
constexpr double kMoving = 1e-3;
/// A sample is within a declaration if it is not beyond α by more than rounding, m.
constexpr double kRounding = 1e-6;
/// FLIGHT_RESULT is repeated for this long. A repeated one bounds the time of the first only to this.
constexpr Duration kResultRepeated{1'200'000};

/// The flown trajectories, as far as requests tell.
class Committed {
 public:
  explicit Committed(const FlightRecord& record) {
    std::vector<Commitments> all = commitments(record);
    if (all.size() != 1) return;
    list_ = std::move(all.front().list);
    for (const UavState& s : record.states) see(s);
  }

  /// Returns the distance of a state from the committed trajectory, m; nothing if the state is off it, or it is
  /// unknown.
  [[nodiscard]] std::optional<double> off(const UavState& state) const {
    const auto k = index_at(state.at);
    if (!k || state.at > list_[*k].known_until || !is_on(state, *k)) return std::nullopt;
    return (state.motion.p - motion_at(list_[*k].curves, state.at).p).cwiseAbs().maxCoeff();
  }
  /// Returns the time up to which the commitment is known without a gap, from t on. @pre it is known at t
  [[nodiscard]] UTime known_until(UTime t) const {
    std::size_t k = index_at(t).value();
    while (k + 1 < list_.size() && list_[k].known_until >= list_[k + 1].spline.start) ++k;
    return list_[k].known_until;
  }
  /// Returns the time from which the commitment is known without a gap, up to t. @pre it is known at t
  [[nodiscard]] UTime known_since(UTime t) const {
    std::size_t k = index_at(t).value();
    while (k > 0 && list_[k - 1].known_until >= list_[k].spline.start) --k;
    return list_[k].spline.start;
  }
  /// Appends its curves over [from, to]. @pre it is known throughout
  void append(UTime from, UTime to, double error, std::vector<MotionSpan>& spans) const {
    while (from < to) {
      const std::size_t k = index_at(from).value();
      const UTime end = k + 1 < list_.size() ? std::min(to, list_[k + 1].spline.start) : to;
      for (const Curve& c : list_[k].curves) add(c, std::max(from, c.from), std::min(end, c.to), error, spans);
      const Curve& last = list_[k].curves.back();
      if (end > last.to) {
        const UTime rests = std::max(from, last.to);
        spans.push_back({stationary_curve(last.p(last.length_s()), rests, end), Vec3::Constant(error)});
      }
      from = end;
    }
  }
  [[nodiscard]] MotionSample at(UTime t) const { return motion_at(list_[index_at(t).value()].curves, t); }

 private:
  static void add(const Curve& curve, UTime from, UTime to, double error, std::vector<MotionSpan>& spans) {
    if (from < to) spans.push_back({curve.cut(from, to), Vec3::Constant(error)});
  }

  [[nodiscard]] std::optional<std::size_t> index_at(UTime t) const {
    const auto next = std::ranges::upper_bound(list_, t, {}, [](const Commitment& c) { return c.spline.start; });
    if (next == list_.begin()) return std::nullopt;
    return idx(next - list_.begin()) - 1;
  }

  [[nodiscard]] bool is_on(const UavState& state, std::size_t k) const {
    return join_gap(state.motion, motion_at(list_[k].curves, state.at)) <= kJoinTolerance;
  }

  /// A trajectory never comes back into force. If a moving vehicle is on one, that one was in force until then.
  void see(const UavState& state) {
    const auto k = index_at(state.at);
    if (!k || state.at <= list_[*k].known_until || !is_on(state, *k)) return;
    const bool seen_lately = state.at - list_[*k].known_until <= kStateHole;
    if (seen_lately || state.motion.v.norm() > kMoving) list_[*k].known_until = state.at;
  }

  std::vector<Commitment> list_;
};

/// Returns the greatest acceleration of the vehicle, per axis, m/s².
Vec3 greatest_acceleration(const FlightRecord& record) {
  Vec3 a = record.requests.empty() ? Vec3::Constant(std::numeric_limits<double>::infinity())
                                   : record.requests.front().limits.a_max;
  for (const UavState& s : record.states) a = a.cwiseMax(s.motion.a.cwiseAbs());
  return a;
}

/// true_motion.h has the bounds.
MotionSpan bridge(UTime from, const MotionSample& a, UTime to, const MotionSample& b, const Vec3& greatest) {
  MotionSpan span{hermite(from, a.p, a.v, to, b.p, b.v)};
  const double h = span.curve.length_s();
  const Vec3 m = greatest + span.curve.a(0.0).cwiseAbs().cwiseMax(span.curve.a(h).cwiseAbs());
  span.error = m * (h * h / 16.0);
  span.speed_error = m.norm() * h / 4.0;
  span.wander_m = m.sum() * h * h / 8.0;
  span.hole = to - from > kStateHole;
  return span;
}

using TrueSample = ObstacleHistory::Sample;

bool keeps_to(const DeclaredPiece& piece, const TrueSample& s) {
  const Vec3 off = s.p - piece.curve.p((s.at - piece.curve.from).seconds());
  return ((off.cwiseAbs() - piece.alpha).array() <= kRounding).all();
}

/// Returns the declaration over [a, b], if it covers that time and both samples are within it. `first`: no earlier
/// piece is needed.
std::optional<std::vector<MotionSpan>> declared_between(const TrueSample& a, const TrueSample& b,
                                                        const std::vector<DeclaredPiece>& pieces, std::size_t& first) {
  if (b.at - a.at > kDeclaredHole) return std::nullopt;
  while (first < pieces.size() && pieces[first].curve.to <= a.at) ++first;
  std::vector<MotionSpan> spans;
  UTime from = a.at;
  for (std::size_t k = first; k < pieces.size() && from < b.at; ++k) {
    const DeclaredPiece& piece = pieces[k];
    if (piece.curve.to <= from) continue;
    if (piece.curve.from > from) return std::nullopt;
    const UTime to = std::min(piece.curve.to, b.at);
    if ((from == a.at && !keeps_to(piece, a)) || (to == b.at && !keeps_to(piece, b))) return std::nullopt;
    spans.push_back({piece.curve.cut(from, to), piece.alpha});
    from = to;
  }
  if (from < b.at) return std::nullopt;
  return spans;
}

bool rests(const ObstacleHistory& history, const TrueSample& a, const TrueSample& b) {
  return !history.moves && a.p == b.p && a.v.isZero() && b.v.isZero();
}

}  // namespace

SampledMotion vehicle_motion(const FlightRecord& record) {
  const Committed committed(record);
  const Vec3 greatest = greatest_acceleration(record);
  SampledMotion motion;
  for (std::size_t k = 0; k + 1 < record.states.size(); ++k) {
    const UavState& a = record.states[k];
    const UavState& b = record.states[k + 1];
    const auto off_a = committed.off(a);
    const auto off_b = committed.off(b);
    const UTime until = off_a ? std::min(b.at, committed.known_until(a.at)) : a.at;
    const UTime since = off_b ? std::max(a.at, committed.known_since(b.at)) : b.at;
    if (until >= since && off_a && off_b) {
      committed.append(a.at, b.at, std::max(*off_a, *off_b), motion.spans);
      continue;
    }
    if (off_a) committed.append(a.at, until, *off_a, motion.spans);
    motion.spans.push_back(bridge(until, until > a.at ? committed.at(until) : a.motion, since,
                                  since < b.at ? committed.at(since) : b.motion, greatest));
    if (off_b) committed.append(since, b.at, *off_b, motion.spans);
  }
  for (const MotionSpan& span : motion.spans) {
    if (!span.hole) continue;
    motion.holes = motion.holes + (span.curve.to - span.curve.from);
    ++motion.hole_count;
  }
  return motion;
}

SampledMotion obstacle_motion(const ObstacleHistory& history, const std::vector<DeclaredPiece>& declared) {
  SampledMotion motion;
  std::size_t first = 0;
  for (std::size_t k = 0; k + 1 < history.samples.size(); ++k) {
    const TrueSample& a = history.samples[k];
    const TrueSample& b = history.samples[k + 1];
    if (rests(history, a, b)) {
      const bool goes_on = k > 0 && rests(history, history.samples[k - 1], a);
      if (goes_on) {
        motion.spans.back().curve.to = b.at;
      } else {
        motion.spans.push_back({stationary_curve(a.p, a.at, b.at)});
      }
    } else if (const auto spans = declared_between(a, b, declared, first)) {
      motion.spans.insert(motion.spans.end(), spans->begin(), spans->end());
    } else if (b.at - a.at <= kTruthHole) {
      MotionSpan span{hermite(a.at, a.p, a.v, b.at, b.p, b.v)};
      span.proven = false;
      motion.spans.push_back(span);
    } else {
      motion.holes = motion.holes + (b.at - a.at);
      ++motion.hole_count;
    }
  }
  return motion;
}

Window judged_window(const FlightRecord& record) {
  if (record.results.empty() || record.requests.empty()) return {record.zero(), record.end(), Duration{}};
  const FlightResult& result = record.results.back();
  if (std::isnan(result.flight_time_s)) return {record.zero(), record.end(), Duration{}};
  const Duration time = Duration::from_seconds(result.flight_time_s);
  UTime latest = result.header.utime;
  if (record.requests.front().id == 1) latest = std::min(latest, record.zero() + time);
  const bool is_first = result.header.name.sequence <= 1;
  const UTime reported_at = is_first ? result.header.utime : result.header.utime - kResultRepeated;
  const auto after = std::ranges::upper_bound(record.states, reported_at, {}, &UavState::at);
  const auto before = after - record.states.begin();
  const UTime earliest = before >= 2 ? record.states[idx(before) - 2].at : latest - time;
  const Duration unsure = std::max(Duration{}, latest - std::min(earliest, latest));
  return {latest - time - unsure, latest, unsure};
}

}  // namespace tern::audit
