#include "planner/app/unseen_intake.h"

#include "messages/channels.h"

namespace tern {
namespace {

bool is_take_off(const HorizonRequest& request, const Vec3& start) {
  const Points& committed = request.committed.control_points;
  const Vec3 way = committed.rowwise().maxCoeff() - committed.rowwise().minCoeff();
  return way.norm() <= kLongestRest && (request.start.p - start).norm() <= kStartReach;
}

}  // namespace

UnseenIntake::UnseenIntake(Bus& bus, const UnseenMovers& movers, const Vec3& start)
    : movers_(movers), start_(start), watch_(movers, start) {
  bus.subscribe(channels::kObstacleSightings, [this](const SightingSet& frame) { watch_.add(frame); });
}

void UnseenIntake::set_vehicle(const HorizonRequest& request) {
  const std::int64_t epoch_us = request.header.name.sender_epoch_us;
  const bool is_first = vehicle_epoch_us_ == 0, is_new = vehicle_epoch_us_ != epoch_us;
  vehicle_epoch_us_ = epoch_us;
  const bool takes_off = is_take_off(request, start_);
  const bool is_known = is_new ? is_first && takes_off : takes_off || watch_.knowledge().field.has_value();
  if (is_known) return;
  UnseenMovers movers = movers_;
  if (!takes_off) movers.clear_radius_m = 0.0;
  watch_ = UnseenWatch(movers, start_);
}

std::shared_ptr<const UnseenKnowledge> UnseenIntake::snapshot() const {
  return std::make_shared<const UnseenKnowledge>(watch_.knowledge());
}

std::string UnseenIntake::missing() const {
  if (watch_.knowledge().field) return "";
  return "OBSTACLE_SIGHTINGS with level rows: no plan is certified against unseen movers without them";
}

}  // namespace tern
