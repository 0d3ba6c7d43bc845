// True clearance in continuous time, from states, truth and map alone.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "core/world/box_cover.h"
#include "tools/audit/audit.h"
#include "tools/audit/body_gap.h"
#include "tools/audit/true_motion.h"

namespace tern::audit {
namespace {

/// Precision of the least distance, m: skipped parts are not lower by more.
constexpr double kResolution = 1e-4;
/// The precision below kNearTouch, where it may be a contact, m.
constexpr double kTouchResolution = 1e-6;
constexpr double kNearTouch = 1e-3;
/// Smaller overlaps are the rounding of coordinates: the body touches, m. The referee has the same rule.
constexpr double kOverlapRounding = 1e-9;
/// The referee's verdict comes at the first contact; this much time after it shows the depth.
constexpr Duration kAfterCollision{100'000};
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Returns the precision for a search whose least so far is `low`.
double resolution(double low) { return low < kNearTouch ? kTouchResolution : kResolution; }

/// Returns the largest amount by which skipped parts may be lower than the final `low`. A part skipped before the
/// search came under kNearTouch is at least kNearTouch − kResolution.
double passed_over(double low) { return low < 0.5 * kNearTouch ? kTouchResolution : kResolution; }

/// Bounds of the least distance. They include the error of the recorded curves.
struct Closest {
  double low = kFar, high = kFar;
  UTime at;
  std::int64_t obstacle = kNoObstacle;  ///< kNoObstacle: nothing nearer than the initial bound

  /// Keeps the candidate if it is lower.
  void lower(double than, UTime when, std::int64_t whom) {
    if (than < low) low = than, at = when, obstacle = whom;
  }
};

/// One time span of the vehicle and one obstacle.
struct Encounter {
  const Body& body;
  Vec3 half;
  Curve relative;  ///< vehicle − obstacle
  Vec3 error;      ///< the true difference is within relative ± error, m
  std::int64_t obstacle = kNoObstacle;
  UTime sure_from, sure_to;  ///< the flight surely contains this span
};

/// Bounds the distance to a box whose centre is known to ± error.
Gap gap_within(const Encounter& e, const Vec3& p) {
  const double low = body_gap(e.body, p, e.half + e.error).low;
  const Vec3 core = e.half - e.error;
  if ((core.array() >= 0.0).all()) return {low, body_gap(e.body, p, core).high};
  return {low, body_gap(e.body, p, e.half).high + e.error.norm()};
}

/// Lowers `best` by the least distance in [a, b], by bisection. Within a stretch the curve strays from its middle at
/// most as far as its Bernstein points do. The distance is 1-Lipschitz, so it changes by at most that.
void search(const Encounter& e, double a, double b, Closest& best, int depth = 0) {
  constexpr int kDeepest = 40;  ///< a nanosecond of 15 minutes; deeper only for absurd numbers
  const double middle = 0.5 * (a + b);
  const Vec3 p = e.relative.p(middle);
  const Gap gap = gap_within(e, p);
  const UTime at = e.relative.from + Duration::from_seconds(middle);
  if (at >= e.sure_from && at <= e.sure_to) best.high = std::min(best.high, gap.high);
  const double stray = (bernstein_points(e.relative, a, b).colwise() - p).colwise().norm().maxCoeff();
  const double low = depth == kDeepest ? gap.low - stray : gap.low;
  best.lower(low, at, e.obstacle);
  if (depth == kDeepest || gap.low - stray >= best.low - resolution(best.low)) return;
  search(e, a, middle, best, depth + 1);
  search(e, middle, b, best, depth + 1);
}

Curve difference(const Curve& a, const Curve& b, UTime from, UTime to) {
  Curve relative = a.cut(from, to);
  const Curve other = b.cut(from, to);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 4; ++i) relative.axis[k].c[i] -= other.axis[k].c[i];
  }
  return relative;
}

/// Returns the encounters of vehicle and obstacle: all common time, without the vehicle's holes.
template <class Visit>
void meet(const SampledMotion& vehicle, const SampledMotion& obstacle, const Window& window, const Visit& visit) {
  std::size_t k = 0;
  for (const MotionSpan& own : vehicle.spans) {
    while (k < obstacle.spans.size() && obstacle.spans[k].curve.to <= own.curve.from) ++k;
    for (std::size_t i = k; i < obstacle.spans.size() && obstacle.spans[i].curve.from < own.curve.to; ++i) {
      const MotionSpan& other = obstacle.spans[i];
      const UTime from = std::max({own.curve.from, other.curve.from, window.from});
      const UTime to = std::min({own.curve.to, other.curve.to, window.to});
      if (from < to && !own.hole) visit(own, other, difference(own.curve, other.curve, from, to));
    }
  }
}

/// The result for one obstacle: proven, or interpolated between its samples if nothing bounds its motion.
struct Approach {
  Closest proven, interpolated;
  bool compared = false;        ///< at any time; false: the log has no vehicle and obstacle at the same time
  bool between_samples = true;  ///< proven between samples as well
};

struct Watch {
  const FlightRecord& record;
  Body body;
  Window window;
  SampledMotion vehicle;
  std::vector<ClearancePoint>& series;

  Approach watch(std::int64_t id, const ObstacleHistory& history, const SampledMotion& motion, double nearest) {
    Approach approach;
    // An obstacle farther than the nearest one so far needs no exact minimum.
    approach.proven.low = approach.interpolated.low = std::max(nearest, kResolution);
    const Vec3 half = largest_half_extents(history);
    std::size_t point = 0;
    meet(vehicle, motion, window, [&](const MotionSpan& own, const MotionSpan& other, const Curve& relative) {
      const Encounter e{body, half, relative, own.error + other.error, id, window.sure_from(), window.sure_to()};
      approach.compared = true;
      search(e, 0.0, relative.length_s(), other.proven ? approach.proven : approach.interpolated);
      if (!other.proven) approach.between_samples = false;
      while (point < series.size() && series[point].at < relative.from) ++point;
      for (; point < series.size() && series[point].at < relative.to; ++point) {
        const double gap = body_gap(body, relative.p((series[point].at - relative.from).seconds()), half).high;
        if (gap < series[point].clearance_m) series[point] = {series[point].at, gap, id};
      }
    });
    at_samples(id, history, approach);
    return approach;
  }

  /// Compares the vehicle with the obstacle at its recorded samples.
  void at_samples(std::int64_t id, const ObstacleHistory& history, Approach& approach) const {
    if (!history.moves) return;
    std::size_t k = 0;
    for (const ObstacleHistory::Sample& s : history.samples) {
      while (k < vehicle.spans.size() && vehicle.spans[k].curve.to < s.at) ++k;
      if (k == vehicle.spans.size() || s.at > window.sure_to()) return;
      const MotionSpan& own = vehicle.spans[k];
      if (own.hole || s.at < own.curve.from || s.at < window.sure_from()) continue;
      const Encounter e{body, s.half_extents, own.curve, own.error, id, window.sure_from(), window.sure_to()};
      const Gap gap = gap_within(e, own.curve.p((s.at - own.curve.from).seconds()) - s.p);
      approach.compared = true;
      approach.proven.high = std::min(approach.proven.high, gap.high);
      approach.proven.lower(gap.low, s.at, id);
    }
  }

  static Vec3 largest_half_extents(const ObstacleHistory& history) {
    Vec3 half = Vec3::Zero();
    for (const ObstacleHistory::Sample& s : history.samples) half = half.cwiseMax(s.half_extents);
    return half;
  }
};

void count_holes(const SampledMotion& motion, const std::string& what, Check& check) {
  if (motion.hole_count == 0) return;
  check.unchecked[fmt::format("{}: {:.2f} s in holes", what, motion.holes.seconds())] += motion.hole_count;
}

/// Returns the samples of OBSTACLE_TRUTH that enclose the flight.
struct Enclosing {
  UTime before{INT64_MIN}, after{INT64_MAX};
};

Enclosing enclosing(const FlightRecord& record, const Window& window) {
  Enclosing e;
  for (const auto& [id, history] : record.truth) {
    for (const ObstacleHistory::Sample& s : history.samples) {
      if (s.at <= window.from) e.before = std::max(e.before, s.at);
      if (s.at >= window.to) e.after = std::min(e.after, s.at);
    }
  }
  return e;
}

/// Returns true if the obstacle may have existed in that time: it may appear one sample earlier, and vanish one later.
bool may_be_met(const ObstacleHistory& history, const Enclosing& e) {
  return history.samples.front().at <= e.after && history.samples.back().at >= e.before;
}

bool is_met(const ObstacleHistory& history, const Window& window) {
  return history.samples.front().at <= window.sure_to() && history.samples.back().at >= window.sure_from();
}

/// Counts moving obstacles that appeared or vanished in flight, at a time known to one sample.
std::int64_t count_passers(const FlightRecord& record, const Window& window, const Enclosing& e) {
  UTime first{INT64_MAX}, last{INT64_MIN};
  for (const auto& [id, history] : record.truth) {
    first = std::min(first, history.samples.front().at);
    last = std::max(last, history.samples.back().at);
  }
  std::int64_t count = 0;
  for (const auto& [id, history] : record.truth) {
    const bool came = history.samples.front().at > std::max(first, window.from);
    const bool went = history.samples.back().at < std::min(last, window.to);
    count += history.moves && may_be_met(history, e) && (came || went) ? 1 : 0;
  }
  return count;
}

/// The word for all obstacles, and whether they are boxes of the map (−1 − k is the k-th, as in a certificate).
struct Names {
  const char* all;
  bool of_map;
};

/// Collects the results of all obstacles.
class Verdicts {
 public:
  Verdicts(const FlightRecord& record, Check& check, Names names = {"obstacles", false})
      : record_(record), check_(check), names_(names) {}

  [[nodiscard]] std::string name_of(std::int64_t id) const {
    return names_.of_map ? fmt::format("box {} of the map", -1 - id) : record_.name_of(id);
  }

  /// Sets how many obstacles surely existed; the other checked ones possibly did.
  void count(std::int64_t surely) { surely_ = surely; }

  /// Returns the nearest distance so far that is not excluded, m.
  [[nodiscard]] double nearest() const { return std::min(proven_.low, interpolated_.low); }

  void take(const Approach& a) {
    if (!a.compared) return void(++check_.unchecked[names_.all + std::string(" beside no state of the vehicle")]);
    ++check_.checked;
    if (!a.between_samples) ++undeclared_;
    proven_.high = std::min(proven_.high, a.proven.high);
    for (const auto& [from, to] : {std::pair{&a.proven, &proven_}, {&a.interpolated, &interpolated_}}) {
      if (from->obstacle != kNoObstacle) to->lower(from->low, from->at, from->obstacle);
    }
    if (a.proven.high < -kOverlapRounding) {
      const Closest& c = a.proven;
      check_.fail({c.at, fmt::format("overlaps {} by {:.3f} m", name_of(c.obstacle), -c.high), 0, c.obstacle});
    } else if (a.proven.obstacle != kNoObstacle && a.proven.low < passed_over(a.proven.low)) {
      undecided(a.proven, "the log is not precise enough");
    } else if (a.interpolated.obstacle != kNoObstacle && a.interpolated.low < passed_over(a.interpolated.low)) {
      undecided(a.interpolated, "by interpolation: its motion was not declared");
    }
  }

  LeastClearance finish(bool whole) {
    if (undeclared_ > 0)
      check_.unchecked["obstacles between their samples: their motion was not declared, or left its declaration"] =
          undeclared_;
    LeastClearance least;
    const bool near = proven_.obstacle != kNoObstacle;
    const Closest& closest = near && proven_.low <= interpolated_.low ? proven_ : interpolated_;
    if (closest.obstacle == kNoObstacle) return least;
    least.known = true;
    least.high = proven_.high;
    least.proven = undeclared_ == 0 && whole;
    least.low = nearest() - passed_over(nearest());
    say(least, closest);
    return least;
  }

 private:
  void undecided(const Closest& c, const char* why) {
    ++undecided_;
    ++check_.unchecked[fmt::format("whether {} was touched at {:.3f} s: {:.6f} to {:.6f} m, {}", name_of(c.obstacle),
                                   record_.seconds(c.at), c.low - passed_over(c.low), c.high, why)];
  }

  void say(const LeastClearance& least, const Closest& closest) {
    const std::int64_t fewest = surely_.value_or(check_.checked);
    check_.summary = fmt::format("least {:.4f} to {:.4f} m, to {} at {:.3f} s{}; {}{} {}{}", least.low, least.high,
                                 name_of(closest.obstacle), record_.seconds(closest.at),
                                 undeclared_ > 0 ? " (between samples by interpolation)" : "",
                                 fewest < check_.checked ? fmt::format("{} to ", fewest) : "", check_.checked,
                                 names_.all, undecided_ > 0 ? fmt::format(", {} too close to tell", undecided_) : "");
    check_.measures = {{least.proven ? "least_m_at_least" : "least_m_by_interpolation", least.low},
                       {"least_m_at_most", least.high},
                       {names_.of_map ? "least_box" : "least_obstacle",
                        static_cast<double>(names_.of_map ? -1 - closest.obstacle : closest.obstacle)},
                       {"least_at_s", record_.seconds(closest.at)},
                       {names_.all, static_cast<double>(check_.checked)}};
  }

  const FlightRecord& record_;
  Check& check_;
  Names names_;
  Closest proven_, interpolated_;
  std::int64_t undeclared_ = 0, undecided_ = 0;
  std::optional<std::int64_t> surely_;
};

/// One box of the map.
struct Wall {
  std::int64_t id;
  Box box;
  double at_least;  ///< lower bound of its distance to the body, from boxes of the flown motion, m
};

/// Sorts the boxes, nearest first.
std::vector<Wall> walls_of(const VoxelMap& map, const Watch& watch) {
  std::vector<Box> flown;
  for (const MotionSpan& span : watch.vehicle.spans) {
    if (span.hole || span.curve.to <= watch.window.from || span.curve.from >= watch.window.to) continue;
    const auto points = bernstein_points(span.curve, 0.0, span.curve.length_s());
    flown.push_back(grown(Box(points.rowwise().minCoeff(), points.rowwise().maxCoeff()), span.error));
  }
  const double reach = watch.body.vertices.colwise().norm().maxCoeff() + watch.body.radius;
  std::vector<Wall> walls;
  for (const Box& box : cover_with_boxes(map, false)) {
    Wall wall{-1 - static_cast<std::int64_t>(walls.size()), box, kFar};
    for (const Box& b : flown) {
      const double apart = b.exteriorDistance(box);
      wall.at_least =
          std::min(wall.at_least, apart > 0.0 ? apart - reach : -kFar);  ///< inside the box: as deep as the box is
    }
    walls.push_back(wall);
  }
  std::stable_sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.at_least < b.at_least; });
  return walls;
}

bool collided(const FlightRecord& record) {
  return !record.results.empty() && record.results.back().outcome == FlightOutcome::Collision;
}

}  // namespace

Check check_map(const FlightRecord& record, Audit& audit) {
  Check check{.name = "map", .claim = "the body stayed clear of the map's occupied voxels, in continuous time"};
  if (record.requests.empty()) check.unchecked["the body is unknown: no HORIZON_REQUEST"] = 1;
  if (record.maps.size() > 1)
    check.unchecked["the map changed in flight: the log does not tell which one was in force"] = 1;
  if (record.requests.empty() || record.maps.size() != 1) return check;
  std::vector<ClearancePoint> nobodys;
  Watch watch{record, record.requests.front().body, judged_window(record), vehicle_motion(record), nobodys};
  if (collided(record)) watch.window.to = watch.window.to + kAfterCollision;
  const std::vector<Wall> walls = walls_of(record.maps.begin()->second, watch);
  if (walls.empty()) {
    check.checked = 1;
    check.summary = "no voxel is occupied";
    return check;
  }
  count_holes(watch.vehicle, channels::kUavState.name, check);
  Verdicts verdicts(record, check, {"boxes", true});
  for (const Wall& wall : walls) {
    if (wall.at_least > verdicts.nearest()) break;
    const Vec3 centre = wall.box.center();
    const ObstacleHistory history{{{watch.window.from, centre, Vec3::Zero(), 0.5 * wall.box.sizes()}}, false};
    const SampledMotion at_rest{{{stationary_curve(centre, watch.window.from, watch.window.to)}}, {}, 0};
    verdicts.take(watch.watch(wall.id, history, at_rest, verdicts.nearest()));
  }
  if (check.checked > 0) check.checked = static_cast<std::int64_t>(walls.size());  ///< all other boxes are farther
  audit.least_of_map = verdicts.finish(watch.vehicle.hole_count == 0);
  return check;
}

Check check_clearance(const FlightRecord& record, Audit& audit) {
  Check check{.name = "clearance", .claim = "the body stayed clear of every true obstacle, in continuous time"};
  if (record.requests.empty()) check.unchecked["the body is unknown: no HORIZON_REQUEST"] = 1;
  if (record.requests.empty()) return check;
  Watch watch{record, record.requests.front().body, judged_window(record), vehicle_motion(record), audit.clearance};
  if (collided(record)) watch.window.to = watch.window.to + kAfterCollision;
  count_holes(watch.vehicle, channels::kUavState.name, check);
  for (const UavState& s : record.states) {
    if (s.at >= watch.window.from && s.at <= watch.window.to) audit.clearance.push_back({s.at, kFar, kNoObstacle});
  }
  Verdicts verdicts(record, check);
  const Enclosing enclosed = enclosing(record, watch.window);
  SampledMotion holes;
  for (const auto& [id, history] : record.truth) {
    if (!may_be_met(history, enclosed)) continue;
    ++audit.obstacle_count.most;
    if (is_met(history, watch.window)) ++audit.obstacle_count.fewest;
    const auto declared = record.declared.find(id);
    const bool is_declared = declared != record.declared.end();
    const SampledMotion motion =
        obstacle_motion(history, is_declared ? declared->second : std::vector<DeclaredPiece>());
    holes.holes = holes.holes + motion.holes;
    holes.hole_count += motion.hole_count;
    verdicts.take(motion.spans.empty() ? Approach{} : watch.watch(id, history, motion, verdicts.nearest()));
  }
  count_holes(holes, channels::kObstacleTruth.name, check);
  if (record.truth_left_out > 0) check.unchecked["obstacles that OBSTACLE_TRUTH left out"] = record.truth_left_out;
  const std::int64_t passers = count_passers(record, watch.window, enclosed);
  if (passers > 0)
    check.unchecked["obstacles that appeared or vanished in flight, at a time known to one sample"] = passers;
  const bool whole =
      watch.vehicle.hole_count == 0 && holes.hole_count == 0 && record.truth_left_out == 0 && passers == 0;
  audit.obstacle_count.known = holes.hole_count == 0 && record.truth_left_out == 0;
  verdicts.count(audit.obstacle_count.fewest);
  audit.least = verdicts.finish(whole);
  std::erase_if(audit.clearance, [](const ClearancePoint& p) { return p.obstacle == kNoObstacle; });
  return check;
}

}  // namespace tern::audit
