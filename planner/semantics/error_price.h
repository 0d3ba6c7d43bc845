// The price of the position's error along a way, in metres of way.
#pragma once

#include <memory>
#include <vector>

#include "core/base/types.h"
#include "planner/semantics/drift.h"
#include "planner/semantics/information_map.h"

namespace tern {

/// The cost of a way that carries its drift:
///
///     J = way + price · (σ_goal + σ_worst)
///
/// λ_att and λ_rep follow from it: a metre through a place costs 1 + price · ∂(σ_goal + σ_worst)/∂ℓ. In the dark the
/// derivative grows with the blind time so far, so no constant λ can state it.
class ErrorPrice {
 public:
  static constexpr double kSample = 1.0;  ///< greatest distance of samples along a way, m

  /// @param price  m/m, > 0  @param speed  at which the way is flown, m/s, > 0
  /// @throws std::invalid_argument for a speed that is not positive
  ErrorPrice(std::shared_ptr<const InformationMap> information, double price, double speed);

  /// Extends the way to the goal, which begins at b with this drift, by the straight step from a to b. Returns its J.
  double extend(const Vec3& a, const Vec3& b, Drift& drift) const;
  /// Returns J, m.
  [[nodiscard]] double cost(const Drift& drift) const;
  [[nodiscard]] const InformationMap& information() const { return *information_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] double price() const { return price_; }

 private:
  std::shared_ptr<const InformationMap> information_;
  double price_, speed_;
};

/// Returns J of a path for a given price and speed.
double priced_cost(const std::vector<Vec3>& path, const ErrorPrice& price);

}  // namespace tern
