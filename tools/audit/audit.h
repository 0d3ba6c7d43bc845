// Recomputes a recorded flight from its messages. Values that the planner computed are not trusted.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "campaign/statistics/coverage.h"
#include "tools/audit/check.h"
#include "tools/audit/contact.h"
#include "tools/audit/flight_record.h"
#include "tools/audit/span.h"

namespace tern::audit {

/// The true clearance at one recorded state.
struct ClearancePoint {
  UTime at;
  double clearance_m = 0.0;  ///< to the nearest obstacle's box, body included; negative in overlap
  std::int64_t obstacle = kNoObstacle;
};

/// The tracking error at one judged state, on the axis on which the vehicle was nearest to the tube's face.
struct TubePoint {
  UTime at;
  double off_m = 0.0;   ///< from its setpoint, ≥ 0
  double tube_m = 0.0;  ///< half-width of the promised tube; the vehicle was outside if it is less than off_m
};

/// Bounds of age bins, s: how long a track had been in PREDICTIONS when an estimate was made. Bin k is
/// (kAges[k − 1], kAges[k]]. The first bin is age 0 alone; the last bin holds every age above the last bound.
inline constexpr std::array kAges{0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0};
inline constexpr std::size_t kAgeBins = kAges.size() + 1;
using ByAge = std::array<std::array<IntervalCount, kHorizons>, kAgeBins>;

/// How many predictions of one track covered its obstacle.
struct TrackCoverage {
  std::int64_t track = 0, obstacle = 0;
  std::int64_t sets = 0, covered = 0;  ///< number of judged intervals, one per set, and of those that covered
                                       ///< throughout
  double worst_m = 0.0;                ///< how far the true box stood out of an interval at most; ≤ 0: never
};

/// Bounds of the flight's least clearance.
struct LeastClearance {
  bool known = false;            ///< the log has an obstacle (an occupied voxel)
  double low = 0.0, high = 0.0;  ///< bounds, m
  bool proven = false;  ///< low is a proven bound; false: interpolated between samples, or messages are missing
};

/// How many obstacles the flight met. An obstacle may appear or vanish between two samples, so these are bounds.
struct ObstacleCount {
  std::int64_t fewest = 0, most = 0;
  bool known = false;  ///< no OBSTACLE_TRUTH is missing
};

/// How the referee's collision agrees with the recomputed clearance.
enum class Collision { None, Agrees, CannotTell, Contradicts };
/// Returns the lower-case name, with "cannot tell" for CannotTell.
const char* to_string(Collision collision);

struct Audit {
  std::vector<Check> checks;
  LogSpan span;                      ///< the part of the flight that the log holds
  std::vector<std::string> missing;  ///< the messages that the log lacks, in words
  std::vector<ClearancePoint> clearance;
  std::vector<TubePoint> tube;
  LeastClearance least, least_of_map;  ///< to the true obstacles; to the occupied voxels
  ObstacleCount obstacle_count;
  Collision collision = Collision::None;
  std::optional<Contact> contact;     ///< set after a collision with an obstacle
  Coverage coverage;                  ///< summed over the flight
  std::vector<CoverageShare> shares;  ///< the same with intervals; each obstacle is one group
  ByAge moving_by_age, rest_by_age;   ///< of estimated tracks
  std::vector<TrackCoverage> tracks;
  double promised_confidence = 1.0;  ///< the lowest confidence of any prediction set

  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] const Check& check(const std::string& name) const;  ///< @throws std::out_of_range
};

Audit audit_flight(const FlightRecord& record);

/// Text for people: a line per check, its findings below it, and last a list of messages that are missing.
std::string to_text(const Audit& audit, const FlightRecord& record);
/// JSON for programs; docs/reference/audit.md lists the keys.
nlohmann::json to_json(const Audit& audit, const FlightRecord& record);

/// Returns the signed distance from p (W) to a region's border, m: Euclidean, negative inside. It is 1-Lipschitz.
double distance_to(const Region& region, const Vec3& p);

// One check per function; each has a source of its own.
Check check_clearance(const FlightRecord& record, Audit& audit);
Check check_map(const FlightRecord& record, Audit& audit);
Check check_limits(const FlightRecord& record);
Check check_continuity(const FlightRecord& record);
Check check_commitment(const FlightRecord& record);
Check check_headings(const FlightRecord& record);
/// Recomputes the field of unseen movers. @pre the log has frames of OBSTACLE_SIGHTINGS
Check check_unseen(const FlightRecord& record);
Check check_tube(const FlightRecord& record, Audit& audit);
Check check_certificates(const FlightRecord& record);
Check check_holds(const FlightRecord& record);
Check check_answers(const FlightRecord& record);
Check check_predictions(const FlightRecord& record, Audit& audit);
Check check_exposure(const FlightRecord& record);
Check check_result(const FlightRecord& record, Audit& audit);

}  // namespace tern::audit
