// A plan together with its inputs, ready to be checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/audit/cubic.h"
#include "tools/audit/flight_record.h"

namespace tern::audit {

/// A predicted obstacle over time: a box with moving centre, as the planner must take it. Before the first piece and
/// after the last one the centre stays, and the box grows at the track's top speed.
class PredictedBox {
 public:
  /// @param alpha  the counted α per piece, m: see counted_alpha()
  PredictedBox(const Track& track, std::vector<Vec3> alpha);

  /// A time span in which the centre moves along `curve`, parameter in [a, b]. Where the box grows, `half` is its
  /// largest half-extents in the span.
  struct Stretch {
    Curve curve;
    double a = 0.0, b = 0.0;
    Vec3 half;
  };
  /// Covers [from, to], seconds after origin, in order.
  [[nodiscard]] std::vector<Stretch> stretches(UTime origin, double from, double to) const;
  /// Returns a box that contains the obstacle over that time; tight to 1e-4 m.
  [[nodiscard]] Box bounds(UTime origin, double from, double to) const;
  [[nodiscard]] const Track& track() const { return track_; }

 private:
  [[nodiscard]] Vec3 half(std::size_t piece) const { return track_.half_extents + alpha_[piece]; }

  const Track& track_;
  std::vector<Vec3> alpha_;
  std::vector<Curve> curves_;
};

/// A plan, the inputs that it names, and its trajectory from t_s on.
struct PlanCase {
  const Plan& plan;
  const HorizonRequest& request;
  const TrackSet& predictions;
  const VoxelMap* map = nullptr;        ///< null: the plan names none
  std::vector<Curve> curves;            ///< from t_s on: interval k of the certificate is curves[k]
  std::vector<PredictedBox> obstacles;  ///< the predictions, with the α that the plan counted

  [[nodiscard]] Vec3 end_point() const { return plan.trajectory.control_points.rightCols<1>(); }
};

/// Returns the α per piece that the plan counted, m. For an estimated track it is α of the plan's level times the
/// plan's scale, constant from t_s + `sure_for` on. For other tracks it is the full α.
/// @pre the track's shares are complete
std::vector<Vec3> counted_alpha(const Track& track, const Plan& plan, UTime t_s);

/// Returns the share of α that a relaxed start counts. It is the largest share in [0, 1] that leaves 1 mm between the
/// body at p and the track at t. It is 0 if there is no room even without α. Precise to 1e-6, rounded down.
double relaxed_share(const Track& track, const std::vector<Vec3>& alpha, const Body& body, const Vec3& p, UTime t);

/// Looks up a plan's inputs. @return nullopt if the log lacks one of them; `why` says which
std::optional<PlanCase> find_case(const FlightRecord& record, const Plan& plan, std::string& why);

}  // namespace tern::audit
