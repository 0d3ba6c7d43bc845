#include "tools/audit/plan_case.h"

#include <algorithm>

#include "tools/audit/body_gap.h"

namespace tern::audit {
namespace {

constexpr double kBoundsTolerance = 1e-4;  // m
constexpr double kStartRoom = 1e-3;        // m
constexpr int kHalvings = 40;
constexpr double kTouching = 1e-6;  // m

/// Returns the trajectory from t_s on: the rest of an interval, then whole intervals.
std::vector<Curve> remaining(const Plan& plan, UTime t_s) {
  std::vector<Curve> rest;
  for (const Curve& c : curves_of(plan.trajectory)) {
    if (c.to > t_s) rest.push_back(c.from < t_s ? c.cut(t_s, c.to) : c);
  }
  return rest;
}

}  // namespace

PredictedBox::PredictedBox(const Track& track, std::vector<Vec3> alpha)
    : track_(track), alpha_(std::move(alpha)), curves_(curves_of(track.motion)) {}

std::vector<PredictedBox::Stretch> PredictedBox::stretches(UTime origin, double from, double to) const {
  if (track_.kind == TrackKind::Static) return {{stationary_curve(curves_.front().p(0.0)), 0.0, 0.0, half(0)}};
  std::vector<Stretch> all;
  const auto grown_by = [&](std::size_t piece, double s) -> Vec3 {
    return half(piece) + Vec3::Constant(track_.top_speed * s);
  };
  const double first = (curves_.front().from - origin).seconds();
  const double last = (curves_.back().to - origin).seconds();
  if (from < first) all.push_back({stationary_curve(curves_.front().p(0.0)), 0.0, 0.0, grown_by(0, first - from)});
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    const double start = (curves_[k].from - origin).seconds();
    const double a = std::max(from - start, 0.0);
    const double b = std::min(to - start, curves_[k].length_s());
    // Where two pieces meet, the later one applies.
    const bool is_now = a == b && from == to && (b < curves_[k].length_s() || k + 1 == curves_.size());
    if (a < b || is_now) all.push_back({curves_[k], a, b, half(k)});
  }
  if (to > last) {
    const Curve& end = curves_.back();
    all.push_back({stationary_curve(end.p(end.length_s())), 0.0, 0.0, grown_by(curves_.size() - 1, to - last)});
  }
  return all;
}

Box PredictedBox::bounds(UTime origin, double from, double to) const {
  Box all;
  for (const Stretch& s : stretches(origin, from, to)) {
    all.extend(grown(enclose(s.curve, s.a, s.b, kBoundsTolerance), s.half));
  }
  return all;
}

std::vector<Vec3> counted_alpha(const Track& track, const Plan& plan, UTime t_s) {
  std::vector<Vec3> alpha = track.alpha;
  if (track.kind != TrackKind::Estimated) return alpha;
  const UTime sure_to = t_s + plan.sure_for;
  UTime begin = track.motion.start;
  Vec3 held = Vec3::Zero();
  for (std::size_t k = 0; k < alpha.size(); ++k) {
    alpha[k] = plan.alpha_scale * track.alpha_at(k, plan.level);
    if (k == 0 || begin <= sure_to) held = alpha[k];
    alpha[k] = alpha[k].cwiseMin(held);
    begin = begin + track.motion.pieces[k].duration;
  }
  return alpha;
}

double relaxed_share(const Track& track, const std::vector<Vec3>& alpha, const Body& body, const Vec3& p, UTime t) {
  const std::vector<Curve> curves = curves_of(track.motion);
  const UTime at = std::clamp(t, curves.front().from, curves.back().to);
  std::size_t k = 0;
  while (k + 1 < curves.size() && curves[k].to <= at) ++k;
  const Vec3 relative = p - curves[k].p((at - curves[k].from).seconds());
  const auto room = [&](double share) { return body_gap(body, relative, track.half_extents + share * alpha[k]).low; };
  if (room(1.0) > kTouching) return 1.0;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (room(middle) > kStartRoom ? low : high) = middle;
  }
  return std::max(0.0, low - 2e-6);
}

std::optional<PlanCase> find_case(const FlightRecord& record, const Plan& plan, std::string& why) {
  const HorizonRequest* request = record.request(plan.inputs.request);
  const auto predictions = record.predictions.find(plan.inputs.predictions);
  const auto map = record.maps.find(plan.inputs.map_version);
  why = "";
  if (request == nullptr) why = "plans whose request is not in the log";
  if (predictions == record.predictions.end()) why = "plans whose predictions are not in the log";
  if (plan.inputs.map_version != 0 && map == record.maps.end()) why = "plans whose map is not in the log";
  if (request == nullptr || !why.empty()) return std::nullopt;
  PlanCase result{plan,
                  *request,
                  predictions->second,
                  map == record.maps.end() ? nullptr : &map->second,
                  remaining(plan, request->t_s),
                  {}};
  for (const Track& track : result.predictions.tracks) {
    std::vector<Vec3> alpha = counted_alpha(track, plan, request->t_s);
    if (plan.relaxed) {
      const double part = relaxed_share(track, alpha, request->body, request->start.p, request->t_s);
      for (Vec3& a : alpha) a *= part;
    }
    result.obstacles.emplace_back(track, std::move(alpha));
  }
  return result;
}

}  // namespace tern::audit
