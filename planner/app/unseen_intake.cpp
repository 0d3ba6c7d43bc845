#include "planner/app/unseen_intake.h"

#include "messages/channels.h"

namespace tern {

UnseenIntake::UnseenIntake(Bus& bus, const UnseenMovers& movers, const Vec3& start)
    : movers_(movers), start_(start), watch_(movers, start) {
  bus.subscribe(channels::kObstacleSightings, [this](const SightingSet& frame) { watch_.add(frame); });
}

void UnseenIntake::set_vehicle(const HorizonRequest& request) {
  const std::int64_t epoch_us = request.header.name.sender_epoch_us;
  if (vehicle_epoch_us_ != 0 && vehicle_epoch_us_ != epoch_us) watch_ = UnseenWatch(movers_, start_);
  vehicle_epoch_us_ = epoch_us;
}

std::shared_ptr<const UnseenKnowledge> UnseenIntake::snapshot() const {
  return std::make_shared<const UnseenKnowledge>(watch_.knowledge());
}

std::string UnseenIntake::missing() const {
  if (watch_.knowledge().field) return "";
  return "OBSTACLE_SIGHTINGS with level rows: no plan is certified against unseen movers without them";
}

}  // namespace tern
