#include "planner/unseen/unseen_watch.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// Times of trajectories are whole microseconds; those of splines may differ from them by rounding, s.
constexpr double kClockStep = 1e-6;

}  // namespace

double first_contact(const UnseenKnowledge& known, const TimedSpline& trajectory, UTime t_s, double radius) {
  const double moving_s = (trajectory.end() - t_s).seconds();
  if (moving_s <= 0.0) return kNoContact;
  if (!known.field) return 0.0;
  const double clear_s = clear_until(trajectory, t_s, *known.field, (t_s - known.at).seconds(), radius);
  return clear_s < moving_s - kClockStep ? clear_s : kNoContact;
}

double upright_radius(const Body& body) { return body.vertices.topRows<2>().colwise().norm().maxCoeff() + body.radius; }

UnseenWatch::UnseenWatch(const UnseenMovers& movers, const Vec3& start) : movers_(movers), start_(start.head<2>()) {}

bool UnseenWatch::add(const SightingSet& frame) {
  const std::pair sensor{frame.header.name.sender_epoch_us, frame.sensor_id};
  std::erase_if(used_, [&](const auto& entry) { return known_.at - entry.second > kSensorForgotten; });
  const auto used = used_.find(sensor);
  if (used == used_.end() && used_.size() >= kMostSensors) return false;
  if (used != used_.end() && frame.at - used->second < kPicturePeriod) return false;
  SightFan fan = level_fan(frame.view);
  if (fan.reach.empty()) return false;
  if (!known_.field) begin(frame);
  follow(fan.eye);
  const UTime at = std::max(known_.at, frame.at);
  fan.age_s = (at - frame.at).seconds();
  known_.field->update((at - known_.at).seconds(), {fan});
  known_.at = at;
  known_.last = frame.header.name;
  ++known_.pictures;
  used_[sensor] = frame.at;
  return true;
}

void UnseenWatch::begin(const SightingSet& frame) {
  const Eigen::Vector2d eye = frame.view.sensor_position.head<2>();
  const int cells = static_cast<int>(std::round(2.0 * kUnseenHalfWindow / kUnseenCell));
  const UnseenGrid grid{eye - Eigen::Vector2d::Constant(kUnseenHalfWindow), kUnseenCell, cells, cells};
  known_.field.emplace(grid, movers_.max_speed_mps, movers_.least_width_m);
  known_.at = frame.at;
  known_.first = frame.header.name;
  if ((eye - start_).norm() > movers_.clear_radius_m) return;
  known_.clear_radius = movers_.clear_radius_m;
  known_.field->clear_ball(eye, known_.clear_radius);
}

void UnseenWatch::follow(const Eigen::Vector2d& eye) {
  const UnseenGrid& grid = known_.field->grid();
  const Eigen::Vector2d middle = grid.origin + Eigen::Vector2d::Constant(kUnseenHalfWindow);
  const Eigen::Vector2d steps = ((eye - middle) / (kWindowStep * grid.cell)).array().round();
  if (steps.isZero()) return;
  known_.field->shift(kWindowStep * static_cast<int>(steps.x()), kWindowStep * static_cast<int>(steps.y()));
}

}  // namespace tern
