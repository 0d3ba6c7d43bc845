// Checks each certificate plane of each plan against recomputed sweeps. A pair without a plane must be separated by its
// boxes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/audit/audit.h"
#include "tools/audit/body_gap.h"
#include "tools/audit/commitment.h"
#include "tools/audit/configured.h"
#include "tools/audit/plan_case.h"

namespace tern::audit {
namespace {

/// A plane may be crossed by this, m: the planner's rounding at coordinates of some 100 m, and the touching tolerance
/// of core/geometry.
constexpr double kPlaneTolerance = 1e-6;
/// Extrema are enclosed to this, m.
constexpr double kExtremum = 1e-8;
/// Room that a relaxed start keeps, and the tolerance of its reckoning, m.
constexpr double kStartRoom = 2e-3;
/// Room that lcmtypes/certificate_plane_t.lcm promises for a body without a radius, m.
constexpr double kPublishedMargin = 1e-9;
constexpr int kMaxParts = 4;

struct Part {
  int interval, part, parts;
  friend auto operator<=>(const Part&, const Part&) = default;
};

std::string words(const Part& p) {
  return p.parts == 1 ? fmt::format("interval {}", p.interval)
                      : fmt::format("interval {}, part {} of {}", p.interval, p.part + 1, p.parts);
}

class CaseCheck {
 public:
  CaseCheck(const PlanCase& plan, bool unknown_is_obstacle, Check& check)
      : case_(plan),
        body_(plan.request.body),
        tube_(plan.request.tube),
        unknown_is_obstacle_(unknown_is_obstacle),
        check_(check) {
    for (const CertificatePlane& c : plan.plan.certificate) planes_[{c.interval, c.part, c.parts}].push_back(&c);
    find_start_room();
  }

  void run() {
    if (case_.plan.outcome == PlanOutcome::KeepCommitted && !same(case_.plan.trajectory, case_.request.committed)) {
      fail("keeps a trajectory that is not the committed one", kNoObstacle);
    }
    for (const CertificatePlane& plane : case_.plan.certificate) on_its_side(plane);
    for (std::size_t k = 0; k < case_.curves.size(); ++k) {
      const Part whole{static_cast<int>(k), 0, 1};
      for (const PredictedBox& obstacle : case_.obstacles) {
        ++check_.checked;
        separated(obstacle, whole);
      }
      if (case_.map != nullptr) voxels(whole);
    }
  }

  [[nodiscard]] std::int64_t planes() const { return static_cast<std::int64_t>(case_.plan.certificate.size()); }
  [[nodiscard]] std::int64_t voxels_checked() const { return voxels_checked_; }

 private:
  struct Span {
    double a, b;
  };
  [[nodiscard]] const Curve& curve(const Part& p) const { return case_.curves[idx(p.interval)]; }
  [[nodiscard]] Span span(const Part& p) const {
    const double step = curve(p).length_s() / p.parts;
    return {p.part * step, p.part + 1 == p.parts ? curve(p).length_s() : (p.part + 1) * step};
  }

  void fail(std::string what, std::int64_t obstacle) {
    check_.fail({case_.request.t_s, std::move(what), case_.request.id, obstacle});
  }

  /// Checks the vehicle's side of a plane.
  void on_its_side(const CertificatePlane& c) {
    ++check_.checked;
    const Part part{c.interval, c.part, c.parts};
    if (idx(c.interval) >= case_.curves.size()) {
      return fail(fmt::format("the plane of obstacle {} names {}, which is over at t_s", c.track, words(part)),
                  c.track);
    }
    const Span s = span(part);
    const Enclosure e = enclose(curve(part).along(c.plane.n), s.a, s.b, kExtremum);
    const double out = e.high + c.plane.d + std::max(body_.radius, kPublishedMargin);
    if (out > kPlaneTolerance) {
      fail(fmt::format("the vehicle crosses the plane of obstacle {} by {:.3g} m in {}", c.track, out, words(part)),
           c.track);
    }
  }

  /// Returns how far a predicted box, grown by the mirrored body, crosses its plane during a part.
  [[nodiscard]] double crossing(const PredictedBox& obstacle, const Plane& plane, const Part& part) const {
    const Span s = span(part);
    double least = INFINITY;
    for (const PredictedBox::Stretch& stretch : obstacle.stretches(curve(part).from, s.a, s.b)) {
      const Enclosure e = enclose(stretch.curve.along(plane.n), stretch.a, stretch.b, kExtremum);
      least = std::min(least, e.low - plane.n.cwiseAbs().dot(stretch.half));
    }
    return -(least + plane.d - reach(plane.n));
  }

  /// Returns how far the body's vertices and the tube reach along n.
  [[nodiscard]] double reach(const Vec3& n) const {
    return (n.transpose() * body_.vertices).maxCoeff() + n.cwiseAbs().dot(tube_);
  }

  /// Returns the region of the vehicle's centre during a part, grown by body and tube.
  [[nodiscard]] Box vehicle_box(const Part& part) {
    const auto known = vehicle_boxes_.find(part);
    if (known != vehicle_boxes_.end()) return known->second;
    const Span s = span(part);
    const Box centre = enclose(curve(part), s.a, s.b, kExtremum);
    return vehicle_boxes_.emplace(part, grown(swept_box(body_, centre), tube_)).first->second;
  }

  static bool apart(const Box& a, const Box& b) {
    return ((a.min() - b.max()).array() >= -kPlaneTolerance).any() ||
           ((b.min() - a.max()).array() >= -kPlaneTolerance).any();
  }

  /// Checks a pair of obstacle and part: by its plane, by boxes, or by halving the part.
  void separated(const PredictedBox& obstacle, const Part& part) {
    const std::int64_t id = obstacle.track().id;
    for (const CertificatePlane* c : planes_of(part)) {
      if (c->track != id) continue;
      const double out = crossing(obstacle, c->plane, part);
      if (out > kPlaneTolerance) {
        fail(fmt::format("obstacle {} crosses its plane by {:.3g} m in {}", id, out, words(part)), id);
      }
      return;
    }
    const Span s = span(part);
    if (apart(vehicle_box(part), obstacle.bounds(curve(part).from, s.a, s.b))) return;
    if (part.parts == kMaxParts) {
      return fail(fmt::format("neither a plane nor a box separates obstacle {} in {}", id, words(part)), id);
    }
    for (int half = 0; half < 2; ++half) separated(obstacle, {part.interval, 2 * part.part + half, 2 * part.parts});
  }

  [[nodiscard]] const std::vector<const CertificatePlane*>& planes_of(const Part& part) const {
    static const std::vector<const CertificatePlane*> kNone;
    const auto found = planes_.find(part);
    return found == planes_.end() ? kNone : found->second;
  }

  /// Returns the region grown by the margin of things known in W.
  [[nodiscard]] Box with_margin(const Box& region) const {
    const auto& error = case_.predictions.pose_error;
    return error ? grown(region, Vec3::Constant(error->margin(region))) : region;
  }

  /// Calls visit(voxel) for each obstacle voxel of the map that a region meets.
  template <class Visit>
  void each_voxel(const Box& region, const Visit& visit) const {
    const VoxelGrid& grid = case_.map->grid;
    const Eigen::Vector3i low = grid.cell_of(region.min()).cwiseMax(0);
    const Eigen::Vector3i high = grid.cell_of(region.max()).cwiseMin(grid.size - Eigen::Vector3i::Ones());
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) {
          const VoxelLabel label = case_.map->labels[idx(grid.index({x, y, z}))];
          const bool is_unknown = unknown_is_obstacle_ && label == VoxelLabel::Unknown;
          if (label == VoxelLabel::Occupied || is_unknown) visit(grid.box({x, y, z}));
        }
      }
    }
  }

  /// Finds the margin that voxels may have at most, since the start lies inside larger ones. A box around the body
  /// stands for it.
  void find_start_room() {
    if (case_.map == nullptr || !case_.predictions.pose_error) return;
    const Vec3& p = case_.request.start.p;
    const Box body = grown(swept_box(body_, Box(p, p)), tube_);
    Box flown = body;
    for (int k = 0; k < static_cast<int>(case_.curves.size()); ++k) flown.extend(vehicle_box({k, 0, 1}));
    const double largest = case_.predictions.pose_error->margin(with_margin(flown));
    each_voxel(grown(body, Vec3::Constant(largest)), [&](const Box& voxel) {
      const double gap = (voxel.min() - body.max()).cwiseMax(body.min() - voxel.max()).maxCoeff();
      start_room_ = std::min(start_room_, std::max(0.0, gap - kStartRoom));
    });
  }

  /// Checks the map's obstacle voxels near a part's box, one by one.
  void voxels(const Part& whole) {
    const Box near = with_margin(vehicle_box(whole));
    each_voxel(near, [&](const Box& voxel) { check_voxel(voxel, near, whole); });
  }

  void check_voxel(Box box, const Box& near, const Part& whole) {
    ++check_.checked;
    ++voxels_checked_;
    const auto& error = case_.predictions.pose_error;
    const double margin = error ? std::min(start_room_, error->margin(box.intersection(near))) : 0.0;
    box = grown(box, Vec3::Constant(margin));
    if (voxel_separated(box, whole)) return;
    const std::string with = margin > 0.0 ? fmt::format(" with its margin of {:.3f} m", margin) : "";
    fail(fmt::format("nothing separates the map's voxel at ({:.2f}, {:.2f}, {:.2f}) m{} in {}", box.center().x(),
                     box.center().y(), box.center().z(), with, words(whole)),
         kNoObstacle);
  }

  [[nodiscard]] bool voxel_separated(const Box& box, const Part& part) {
    if (apart(vehicle_box(part), box)) return true;
    const Vec3 half = 0.5 * box.sizes();
    for (const CertificatePlane* c : planes_of(part)) {
      const Vec3& n = c->plane.n;
      const double least = n.dot(box.center()) - n.cwiseAbs().dot(half) - reach(n);
      if (c->track < 0 && least + c->plane.d >= -kPlaneTolerance) return true;
    }
    if (part.parts == kMaxParts) return false;
    return voxel_separated(box, {part.interval, 2 * part.part, 2 * part.parts}) &&
           voxel_separated(box, {part.interval, 2 * part.part + 1, 2 * part.parts});
  }

  const PlanCase& case_;
  const Body& body_;
  const Vec3& tube_;
  bool unknown_is_obstacle_;
  Check& check_;
  std::map<Part, std::vector<const CertificatePlane*>> planes_;
  std::map<Part, Box> vehicle_boxes_;
  double start_room_ = INFINITY;
  std::int64_t voxels_checked_ = 0;
};

/// Returns how far the body at the end point overlaps a moving box, m; 0 for no overlap. Time is bisected. Each stretch
/// is bounded by its middle and by how far the centre strays from there.
double overlap(const Body& body, const Vec3& point, const PredictedBox::Stretch& s, double a, double b, int depth) {
  constexpr int kDeepest = 30;
  const Vec3 centre = s.curve.p(0.5 * (a + b));
  const Gap gap = body_gap(body, point - centre, s.half);
  if (gap.high < -kPlaneTolerance) return -gap.high;
  const double stray = (bernstein_points(s.curve, a, b).colwise() - centre).colwise().norm().maxCoeff();
  if (gap.low - stray >= -kPlaneTolerance || depth == kDeepest) return 0.0;
  const double first = overlap(body, point, s, a, 0.5 * (a + b), depth + 1);
  return first > 0.0 ? first : overlap(body, point, s, 0.5 * (a + b), b, depth + 1);
}

void check_hold(const PlanCase& plan, Check& check) {
  const UTime end = std::max(plan.plan.trajectory.end(), plan.request.t_s);
  const Vec3 p = plan.end_point();
  const Body& body = plan.request.body;
  for (const PredictedBox& obstacle : plan.obstacles) {
    ++check.checked;
    for (PredictedBox::Stretch s : obstacle.stretches(end, 0.0, plan.plan.hold.seconds())) {
      s.half += plan.request.tube;
      const double depth = overlap(body, p, s, s.a, s.b, 0);
      if (depth <= 0.0) continue;
      const std::int64_t id = obstacle.track().id;
      check.fail({end, fmt::format("obstacle {} may reach the end point by {:.3g} m within the hold", id, depth),
                  plan.request.id, id});
      break;
    }
  }
}

/// Calls visit(case) for each plan with a certificate, and counts those whose inputs are not in the log.
template <class Visit>
void for_each_case(const FlightRecord& record, Check& check, const Visit& visit) {
  for (const Plan& plan : record.plans) {
    if (plan.outcome == PlanOutcome::NoPlan) continue;
    std::string why;
    const auto found = find_case(record, plan, why);
    if (found) {
      visit(*found);
    } else {
      ++check.unchecked[why];
    }
  }
}

}  // namespace

Check check_certificates(const FlightRecord& record) {
  Check check{.name = "certificates",
              .claim = "each plan is separated from every predicted obstacle, as its certificate says"};
  const bool unknown = planner_setting(record, "unknown") == "obstacle";
  std::int64_t plans = 0, planes = 0, voxels = 0, relaxed = 0;
  for_each_case(record, check, [&](const PlanCase& plan) {
    CaseCheck one(plan, unknown, check);
    one.run();
    ++plans;
    planes += one.planes();
    voxels += one.voxels_checked();
    relaxed += plan.plan.relaxed ? 1 : 0;
  });
  check.summary =
      fmt::format("{} plans, {} planes, {} pairs{}; {} plans with alpha relaxed at the start", plans, planes,
                  check.checked - planes, voxels > 0 ? fmt::format(" ({} with voxels)", voxels) : "", relaxed);
  check.measures = {{"plans", static_cast<double>(plans)},
                    {"planes", static_cast<double>(planes)},
                    {"relaxed_plans", static_cast<double>(relaxed)}};
  return check;
}

Check check_holds(const FlightRecord& record) {
  Check check{.name = "holds", .claim = "each plan's end stays clear of every predicted obstacle for its hold"};
  double shortest = INFINITY;
  for_each_case(record, check, [&](const PlanCase& plan) {
    check_hold(plan, check);
    if (plan.plan.reason != PlanReason::AtGoal) shortest = std::min(shortest, plan.plan.hold.seconds());
  });
  if (check.checked > 0 && std::isfinite(shortest)) {
    check.summary = fmt::format("the shortest hold is {:.2f} s", shortest);
    check.measures = {{"shortest_hold_s", shortest}};
  }
  return check;
}

}  // namespace tern::audit
