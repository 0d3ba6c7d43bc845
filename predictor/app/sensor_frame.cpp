#include "predictor/app/sensor_frame.h"

#include <fmt/format.h>

#include <utility>

#include "messages/channels.h"
#include "predictor/models/declared.h"
#include "predictor/tracking/usable.h"

namespace tern {
namespace {

const SightingSet* sightings_of(const SensorFrame& frame) { return std::get_if<SightingSet>(&frame.set); }

}  // namespace

const Header& SensorFrame::header() const {
  return std::visit([](const auto& of) -> const Header& { return of.header; }, set);
}

UTime SensorFrame::at() const {
  return std::visit([](const auto& of) { return of.at; }, set);
}

std::int32_t SensorFrame::sensor_id() const {
  return std::visit([](const auto& of) { return of.sensor_id; }, set);
}

std::size_t SensorFrame::size() const {
  const SightingSet* sightings = sightings_of(*this);
  return sightings != nullptr ? sightings->sightings.size() : std::get<ObservationSet>(set).detections.size();
}

std::string SensorFrame::input_name() const {
  return fmt::format("obstacle {} of sensor {}", sightings_of(*this) != nullptr ? "sightings" : "observations",
                     sensor_id());
}

void SensorFrame::count_late(Bus& bus) const {
  if (sightings_of(*this) != nullptr) {
    bus.count_late(channels::kObstacleSightings);
  } else {
    bus.count_late(channels::kObstacleObservations);
  }
}

void SensorFrame::remove_explained(const std::vector<Track>& declared) {
  set = std::visit([&](auto& of) -> decltype(set) { return without_explained(std::move(of), declared); }, set);
}

std::size_t SensorFrame::remove_unusable() {
  return std::visit([](auto& of) { return tern::remove_unusable(of); }, set);
}

std::size_t SensorFrame::remove_foreign_ids() {
  ObservationSet* detections = std::get_if<ObservationSet>(&set);
  return detections != nullptr ? tern::remove_foreign_ids(*detections) : 0;
}

UpdateOutcome SensorFrame::give_to(Tracker& tracker, const std::optional<Vec3>& vehicle) const {
  if (const SightingSet* sightings = sightings_of(*this))
    return tracker.update(*sightings, vehicle.value_or(sightings->view.sensor_position));
  const ObservationSet& detections = std::get<ObservationSet>(set);
  return tracker.update(detections, vehicle.value_or(detections.sensor_position));
}

}  // namespace tern
