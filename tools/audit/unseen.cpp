// Whether the vehicle could always come to rest before a mover that no sensor had seen could touch it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "tools/audit/audit.h"
#include "tools/audit/configured.h"
#include "tools/audit/cubic.h"
#include "tools/audit/unseen_space.h"

namespace tern::audit {
namespace {

/// The vehicle's motion is tested at times so far apart, s.
constexpr double kTick = 0.01;
constexpr double kNever = std::numeric_limits<double>::infinity();

double setting(const FlightRecord& record, const char* key, double otherwise) {
  const std::string text = planner_setting(record, std::string("unseen_movers.") + key);
  return text.empty() ? otherwise : std::strtod(text.c_str(), nullptr);
}

/// The movers that the planner reckoned with, or the default ones.
UnseenMover mover_of(const FlightRecord& record) {
  UnseenMover mover;
  mover.max_speed = setting(record, "max_speed_mps", mover.max_speed);
  mover.least_width = setting(record, "least_width_m", mover.least_width);
  mover.clear_radius = setting(record, "clear_radius_m", mover.clear_radius);
  return mover;
}

/// The radius of the body with its tube about the vertical, m.
double radius_of(const HorizonRequest& request) {
  double radius = 0.0;
  for (Eigen::Index k = 0; k < request.body.vertices.cols(); ++k) {
    const Vec3 v = request.body.vertices.col(k).cwiseAbs() + request.tube;
    radius = std::max(radius, std::hypot(v.x(), v.y()));
  }
  return radius + request.body.radius;
}

/// A time of the flight, split by whether the committed trajectory was passively safe.
struct Shares {
  double all_s = 0.0, safe_s = 0.0;
  double moving_s = 0.0, safe_moving_s = 0.0;

  void add(double seconds, bool moves, bool safe) {
    all_s += seconds;
    safe_s += safe ? seconds : 0.0;
    moving_s += moves ? seconds : 0.0;
    safe_moving_s += moves && safe ? seconds : 0.0;
  }
  static double share(double part, double whole) { return whole > 0.0 ? part / whole : 1.0; }
};

class UnseenCheck {
 public:
  UnseenCheck(const FlightRecord& record, Check& check)
      : record_(record),
        check_(check),
        mover_(mover_of(record)),
        space_(mover_, record.requests.front().start.p.head<2>()) {}

  /// Judges the committed trajectory of a request from t_s on, by the frames that came before the request.
  /// @param lasts_s  until the next request, or the end of the flight
  void judge(const HorizonRequest& request, double lasts_s) {
    const std::size_t until = record_.frames_before.at(request.header.name);
    for (; next_ < until; ++next_) space_.add(record_.frames[next_]);
    const bool moves = request.t_s < request.committed.end();
    const double contact_s = moves ? contact_of(request) : kNever;
    const bool safe = contact_s == kNever;
    ++check_.checked;
    shares_.add(lasts_s, moves, safe);
    if (!safe) contacts_.push_back(contact_s);
    left_ += was_safe_ && !safe ? 1 : 0;
    was_safe_ = safe;
  }

  void summarize() {
    const double all = Shares::share(shares_.safe_s, shares_.all_s);
    const double moving = Shares::share(shares_.safe_moving_s, shares_.moving_s);
    std::ranges::sort(contacts_);
    check_.summary = fmt::format(
        "movers of {:.2f} m/s: passively safe {:.1f} % of the time, {:.1f} % of it while moving; left {} times",
        mover_.max_speed, all * 100.0, moving * 100.0, left_);
    check_.measures = {{"passively_safe_share", all},
                       {"passively_safe_share_moving", moving},
                       {"times_left", static_cast<double>(left_)},
                       {"frames_used", static_cast<double>(space_.frames())}};
    if (contacts_.empty()) return;
    check_.summary += fmt::format(", then contact after {:.2f} s or later, at the median {:.2f} s", contacts_.front(),
                                  contacts_[contacts_.size() / 2]);
    check_.measures.emplace_back("least_time_to_contact_s", contacts_.front());
    check_.measures.emplace_back("median_time_to_contact_s", contacts_[contacts_.size() / 2]);
  }

 private:
  /// When somebody unseen may touch the vehicle first before it rests, s after t_s.
  [[nodiscard]] double contact_of(const HorizonRequest& request) const {
    const std::vector<Curve> curves = curves_of(request.committed);
    const double rest_s = (request.committed.end() - request.t_s).seconds();
    const double late_s = (request.t_s - space_.at()).seconds(), radius = radius_of(request);
    if (space_.frames() == 0) return 0.0;
    const int ticks = static_cast<int>(std::ceil(rest_s / kTick));
    for (int k = 0; k < ticks; ++k) {
      const double s = k * kTick;
      const MotionSample m = motion_at(curves, request.t_s + Duration::from_seconds(s));
      const double margin = 0.5 * kTick * (m.v.head<2>().norm() + mover_.max_speed);
      if (space_.distance(m.p.head<2>()) - mover_.max_speed * (s + late_s) <= radius + margin) return s;
    }
    return kNever;
  }

  const FlightRecord& record_;
  Check& check_;
  UnseenMover mover_;
  UnseenSpace space_;
  std::size_t next_ = 0;
  Shares shares_;
  std::vector<double> contacts_;  ///< times to contact of committed trajectories that were not safe, s
  std::int64_t left_ = 0;         ///< how often a safe trajectory was followed by another one
  bool was_safe_ = true;
};

}  // namespace

Check check_unseen(const FlightRecord& record) {
  Check check{.name = "unseen", .claim = "the share of time in which no unseen mover could touch the moving vehicle"};
  if (record.requests.empty()) return check;
  UnseenCheck unseen(record, check);
  const std::vector<HorizonRequest>& requests = record.requests;
  for (std::size_t k = 0; k < requests.size(); ++k) {
    const UTime next = k + 1 < requests.size() ? requests[k + 1].t_s : record.end();
    unseen.judge(requests[k], std::max(0.0, (next - requests[k].t_s).seconds()));
  }
  unseen.summarize();
  return check;
}

}  // namespace tern::audit
