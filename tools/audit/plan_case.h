// A plan with all that it was made from, ready to be checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A predicted obstacle over time, as the planner was told to take it: a box about a moving centre. Before its first
/// piece and after its last it stays where the piece begins or ends, and grows at its top speed.
class PredictedBox {
 public:
  /// @param alpha  that counts, per piece, m: see PlanCase
  PredictedBox(const Track& track, std::vector<Vec3> alpha);

  /// A stretch of time: the centre moves along `curve` for its parameter in [a, b]; half-extents are the largest ones
  /// where they grow.
  struct Stretch {
    Curve curve;
    double a = 0.0, b = 0.0;
    Vec3 half;
  };
  /// All of [from, to], seconds after origin, in order.
  [[nodiscard]] std::vector<Stretch> stretches(UTime origin, double from, double to) const;
  /// Holds the box over that time; tight to 1e-4 m.
  [[nodiscard]] Box bounds(UTime origin, double from, double to) const;
  [[nodiscard]] const Track& track() const { return track_; }

 private:
  [[nodiscard]] Vec3 half(std::size_t piece) const { return track_.half_extents + alpha_[piece]; }

  const Track& track_;
  std::vector<Vec3> alpha_;
  std::vector<Curve> curves_;
};

/// What a plan says it was made from, and its trajectory from t_s on.
struct PlanCase {
  const Plan& plan;
  const HorizonRequest& request;
  const TrackSet& predictions;
  const VoxelMap* map = nullptr;        ///< null: the plan names none
  std::vector<Curve> curves;            ///< from t_s on: interval k of the certificate is curves[k]
  std::vector<PredictedBox> obstacles;  ///< of the predictions; α as the plan says that it counts

  [[nodiscard]] Vec3 end_point() const { return plan.trajectory.control_points.rightCols<1>(); }
};

/// Per piece, the α that the plan counts, m. Of what is estimated it is that of the plan's level, times its scale, and
/// it grows no more from `sure_for` after t_s on. Of the rest it is all. @pre the track's shares are complete
std::vector<Vec3> counted_alpha(const Track& track, const Plan& plan, UTime t_s);

/// Of that α, the largest part that leaves the body at p a millimetre of room from the track at t: what `relaxed`
/// promises. It is 1 where there is room with all of it, 0 where there is none without any. To 1e-6, low.
double relaxed_share(const Track& track, const std::vector<Vec3>& alpha, const Body& body, const Vec3& p, UTime t);

/// Puts a plan together with its inputs. @return nullopt, and the reason in `why`, if the log lacks one of them.
std::optional<PlanCase> find_case(const FlightRecord& record, const Plan& plan, std::string& why);

}  // namespace tern::audit
