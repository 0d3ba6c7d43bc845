// Whether the referee's verdict agrees with what was recomputed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/world/names.h"
#include "tools/audit/audit.h"
#include "tools/audit/measures.h"

namespace tern::audit {
namespace {

/// The referee's least clearance is attained, and at most this much above the true least, m (simulator/referee).
constexpr double kClearanceOff = 1e-3;
/// Rounding of two computations at coordinates of up to 1e5 m, m.
constexpr double kRounding = 1e-6;
/// Error of the referee's path length, which it sums by three-point Gauss quadrature over steps of 0.01 s. If the speed
/// is smooth over a step, it is this share of the path …
constexpr double kPathShare = 1e-4;
/// … If the speed falls to zero and rises again within a step, at a m/s², it is 0.035 a h². That is the error of the
/// quadrature for |t| on [−h/2, h/2].
constexpr double kKink = 0.035;
constexpr double kRefereeStep = 0.01;  // s
/// Rounding of the speed, as a share.
constexpr double kSpeedShare = 1e-6;
constexpr double kShown = 5e-3;

std::string text(const Between& x) {
  if (x.high - x.low < kShown) return fmt::format("{:.6g}", x.best);
  return fmt::format("{:.6g} to {:.6g}", x.low, x.high);
}

class ResultCheck {
 public:
  ResultCheck(const FlightRecord& record, Audit& audit, Check& check)
      : result_(record.results.back()), audit_(audit), check_(check), measures_(measure(record)) {
    for (const UavState& s : record.states)
      greatest_acceleration_ = std::max(greatest_acceleration_, s.motion.a.norm());
  }

  void run() {
    collision();
    clearance("clearance", audit_.least, result_.min_clearance_m);
    clearance("clearance of the map", audit_.least_of_map, result_.min_map_clearance_m);
    obstacles();
    agree("path length", result_.path_length_m, measures_.path_m, path_off());
    agree("top speed", result_.top_speed_mps, measures_.top_speed, kRounding + kSpeedShare * measures_.top_speed.best);
    if (measures_.unseen_s > 0.0) {
      ++check_.unchecked[fmt::format("{:.2f} s of the flight lie before the log's first state or after its last",
                                     measures_.unseen_s)];
    }
    check_.summary = fmt::format("{} after {:.2f} s and {} m{}{}", to_string(result_.outcome), result_.flight_time_s,
                                 text(measures_.path_m), result_.detail.empty() ? "" : ": ", result_.detail);
    check_.measures = {{"path_m", measures_.path_m.best}, {"top_speed_mps", measures_.top_speed.best}};
    bounds("path_m", measures_.path_m);
    bounds("top_speed_mps", measures_.top_speed);
  }

 private:
  void fail(std::string what) { check_.fail({result_.header.utime, std::move(what)}); }

  /// Returns the tolerance of the path length, m. Each stop, the start and the end are two kinks.
  [[nodiscard]] double path_off() const {
    const auto kinks = static_cast<double>(2 * (result_.stops + 2));
    return kRounding + kPathShare * measures_.path_m.best +
           kinks * kKink * greatest_acceleration_ * kRefereeStep * kRefereeStep;
  }

  void collision() {
    ++check_.checked;
    const LeastClearance& least = audit_.least;
    const bool overlapped = audit_.check("clearance").broken + audit_.check("map").broken > 0;
    if (result_.outcome != FlightOutcome::Collision) {
      if (overlapped)
        fail(fmt::format("FLIGHT_RESULT says {}, but the body overlapped an obstacle or the map",
                         to_string(result_.outcome)));
      return;
    }
    const auto is_clear = [](const LeastClearance& l) { return l.known && l.proven && l.low > 0.0; };
    const bool by_map = std::isfinite(result_.min_map_clearance_m) && !is_clear(audit_.least_of_map);
    const bool contradicted = is_clear(least) && !by_map;
    audit_.collision = overlapped ? Collision::Agrees : contradicted ? Collision::Contradicts : Collision::CannotTell;
    if (contradicted)
      fail(fmt::format("FLIGHT_RESULT says collision, but the least clearance is at least {:.4f} m", least.low));
    if (audit_.collision == Collision::CannotTell) ++check_.unchecked["the collision that FLIGHT_RESULT reports"];
  }

  void clearance(const char* what, const LeastClearance& least, double reported) {
    if (!least.known || !std::isfinite(reported)) return;
    if (result_.outcome == FlightOutcome::Collision) return;  ///< the referee measures to the end of its step only
    ++check_.checked;
    const bool too_low = least.proven && reported < least.low - kRounding;
    if (!least.proven) ++check_.unchecked[fmt::format("whether FLIGHT_RESULT's least {} is too low", what)];
    if (too_low || reported > least.high + kClearanceOff) {
      fail(fmt::format("FLIGHT_RESULT says least {} {:.4f} m, recomputed {:.4f} to {:.4f} m", what, reported, least.low,
                       least.high));
    }
  }

  void obstacles() {
    const ObstacleCount& obstacle_count = audit_.obstacle_count;
    if (!obstacle_count.known || obstacle_count.most == 0 || result_.outcome == FlightOutcome::Collision) return;
    ++check_.checked;
    if (result_.obstacles >= obstacle_count.fewest && result_.obstacles <= obstacle_count.most) return;
    fail(fmt::format("FLIGHT_RESULT says {} obstacles, recomputed {} to {}", result_.obstacles, obstacle_count.fewest,
                     obstacle_count.most));
  }

  void agree(const char* what, double reported, const Between& found, double off) {
    ++check_.checked;
    if (reported >= found.low - off && reported <= found.high + off) return;
    fail(fmt::format("FLIGHT_RESULT says {} {:.6g}, recomputed {}", what, reported, text(found)));
  }

  void bounds(const std::string& name, const Between& x) {
    check_.measures.emplace_back(name + "_at_least", x.low);
    if (std::isfinite(x.high)) check_.measures.emplace_back(name + "_at_most", x.high);
  }

  const FlightResult& result_;
  Audit& audit_;
  Check& check_;
  Measures measures_;
  double greatest_acceleration_ = 0.0;  ///< m/s²
};

}  // namespace

Check check_result(const FlightRecord& record, Audit& audit) {
  Check check{.name = "result", .claim = "the referee's verdict agrees with what was recomputed"};
  if (record.results.empty()) {
    check.unchecked["the flight has no FLIGHT_RESULT"] = 1;
    return check;
  }
  ResultCheck(record, audit, check).run();
  return check;
}

}  // namespace tern::audit
