// A flight with known contents, so tests can predict what the page shows.
#pragma once

#include "core/wire/health.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/observation.h"
#include "core/world/search_view.h"
#include "core/world/sighting.h"
#include "core/world/track.h"
#include "core/world/vehicle.h"
#include "core/world/voxel_map.h"

namespace tern::support {

/// The vehicle flies for 20 s at 1 m/s from (0, 0, 1), along x unless another course is given. 20 pillars stand at
/// (k, 3, 1); 10 moving obstacles oscillate slowly about (2 k, −3, 1). About 8 m ahead of the start there is an
/// attracting box left of the path, and a repelling one right of it.
inline constexpr int kKnownPillars = 20, kKnownMovers = 10;
inline constexpr double kKnownSpeed = 1.0;  ///< m/s
inline constexpr double kKnownSeconds = 20.0;

class KnownScene {
 public:
  /// @param course  of the flight, rad from x to y
  explicit KnownScene(UTime start, double course = 0.0);

  [[nodiscard]] UavState state(UTime now) const;
  [[nodiscard]] ObstacleTruth truth(UTime now) const;
  /// Detects every mover, by its id.
  [[nodiscard]] ObservationSet observations(UTime now) const;
  /// A camera that looks along the course: a picture of 3 × 4 cells, and pillar 10 as its sighting.
  [[nodiscard]] SightingSet sightings(UTime now) const;
  /// Predicts moving obstacles by one piece of 3.5 s at their present velocity, α 0.2 m.
  [[nodiscard]] TrackSet predictions(UTime now) const;
  /// Requests a plan from the vehicle's position to 4 m ahead.
  [[nodiscard]] HorizonRequest request(UTime now, std::int64_t id) const;
  /// The optimized answer, with one plane against pillar 0.
  [[nodiscard]] Plan plan(const HorizonRequest& request) const;
  [[nodiscard]] PlanTiming timing(std::int64_t request_id) const;
  /// A search of three nodes and two edges.
  [[nodiscard]] SearchView search(std::int64_t request_id) const;
  [[nodiscard]] Goal goal() const;
  [[nodiscard]] Heartbeat heartbeat() const;
  /// Names pillar 10 "gate".
  [[nodiscard]] ConfigurationReport configuration() const;
  [[nodiscard]] VoxelMap map() const;

 private:
  UTime start_;
  Vec3 ahead_;  ///< unit vector of the course
};

}  // namespace tern::support
