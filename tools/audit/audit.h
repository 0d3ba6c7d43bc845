// Recomputes a flight from what was recorded, and trusts nothing that the planner said of it.
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

namespace tern::audit {

/// How near the flight came to what really was there, at each state.
struct ClearancePoint {
  UTime at;
  double clearance_m = 0.0;  ///< to the nearest obstacle's box, body included; negative in overlap
  std::int64_t obstacle = kNoObstacle;
};

/// Where the vehicle was in its tube at a state that is judged: on the axis on which it was nearest to the edge.
struct TubePoint {
  UTime at;
  double off_m = 0.0;   ///< its setpoint, ≥ 0
  double tube_m = 0.0;  ///< what was promised; less than off_m: it was outside
};

/// Estimates by how long their track had been in PREDICTIONS, s: bin k is (kAges[k − 1], kAges[k]], the first one 0
/// alone, the last one all that is older.
inline constexpr std::array kAges{0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0};
inline constexpr std::size_t kAgeBins = kAges.size() + 1;
using ByAge = std::array<std::array<PromiseCount, kHorizons>, kAgeBins>;

/// What one track promised and covered.
struct TrackCoverage {
  std::int64_t track = 0, obstacle = 0;
  std::int64_t sets = 0, covered = 0;  ///< promises (a set's pieces) that truth reaches; those that held throughout
  double worst_m = 0.0;                ///< farthest that the true box stood out of its promise; ≤ 0: never
};

/// The least clearance of the flight.
struct LeastClearance {
  bool known = false;            ///< there was something to be near to
  double low = 0.0, high = 0.0;  ///< it lies between them, m
  bool proven = false;  ///< low is a bound; false: between samples by interpolation, or without what is missing
};

/// How many obstacles were there at some time of the flight: between its samples some may have come or gone.
struct ObstacleCount {
  std::int64_t fewest = 0, most = 0;
  bool known = false;  ///< the log tells of all: no OBSTACLE_TRUTH is missing
};

/// What the referee saw of a collision, against what was recomputed.
enum class Collision { None, Agrees, CannotTell, Contradicts };
/// "none", "agrees", "cannot tell", "contradicts".
const char* to_string(Collision collision);

struct Audit {
  std::vector<Check> checks;
  std::vector<std::string> missing;  ///< what the log lacks, in words
  std::vector<ClearancePoint> clearance;
  std::vector<TubePoint> tube;
  LeastClearance least, least_of_map;  ///< to the true obstacles; to the occupied voxels
  ObstacleCount obstacle_count;
  Collision collision = Collision::None;
  std::optional<Contact> contact;    ///< of a collision with an obstacle
  Coverage coverage;                 ///< of the flight
  std::vector<KeptShare> shares;     ///< the same with its intervals, the obstacles being groups
  ByAge moving_by_age, rest_by_age;  ///< of estimates
  std::vector<TrackCoverage> tracks;
  double promised_confidence = 1.0;  ///< the least that a prediction set said

  [[nodiscard]] Verdict verdict() const;
  [[nodiscard]] const Check& check(const std::string& name) const;  ///< @throws std::out_of_range
};

Audit audit_flight(const FlightRecord& record);

/// For people: a line per check, the findings below it, at last what could not be checked.
std::string to_text(const Audit& audit, const FlightRecord& record);
/// For programs. docs/after_the_flight.md lists the keys.
nlohmann::json to_json(const Audit& audit, const FlightRecord& record);

/// Signed distance from p (W) to a region, m: the Euclidean one outside, minus that to its border inside. 1-Lipschitz.
double distance_to(const Region& region, const Vec3& p);

// The checks, in files of their own.
Check check_clearance(const FlightRecord& record, Audit& audit);
Check check_map(const FlightRecord& record, Audit& audit);
Check check_limits(const FlightRecord& record);
Check check_continuity(const FlightRecord& record);
Check check_commitment(const FlightRecord& record);
Check check_tube(const FlightRecord& record, Audit& audit);
Check check_certificates(const FlightRecord& record);
Check check_holds(const FlightRecord& record);
Check check_answers(const FlightRecord& record);
Check check_predictions(const FlightRecord& record, Audit& audit);
Check check_exposure(const FlightRecord& record);
Check check_result(const FlightRecord& record, Audit& audit);

}  // namespace tern::audit
