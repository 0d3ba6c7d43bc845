// One frame of a sensor that sends detections or sightings, as the node waits with it and counts it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/wire/header.h"
#include "core/world/observation.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "predictor/tracking/tracker.h"
#include "runtime/bus.h"

namespace tern {

struct SensorFrame {
  std::variant<ObservationSet, SightingSet> set;

  [[nodiscard]] const Header& header() const;
  [[nodiscard]] UTime at() const;
  [[nodiscard]] std::int32_t sensor_id() const;
  /// Detections or sightings.
  [[nodiscard]] std::size_t size() const;
  /// In words: "obstacle sightings of sensor 2".
  [[nodiscard]] std::string input_name() const;
  void count_late(Bus& bus) const;

  /// Removes what declared tracks explain (declared.h).
  void remove_explained(const std::vector<Track>& declared);
  /// Removes what is too uncertain to use (usable.h). @return its number
  std::size_t remove_unusable();
  std::size_t remove_foreign_ids();
  /// @param vehicle  W, m; the sensor's place if it is not known
  UpdateOutcome give_to(Tracker& tracker, const std::optional<Vec3>& vehicle) const;
};

}  // namespace tern
