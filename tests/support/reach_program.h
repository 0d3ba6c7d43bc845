// Oracle of AxisReach: one axis of the clamped spline as a linear program.
#pragma once

#include <optional>

namespace tern::oracle {

/// The program: v_{k+1} = v_k + a_k Δt for k = l … J − 1, v_J = 0, a_J = 0, |v_k| ≤ v_max, |a_k| ≤ a_max,
/// |a_k − a_{k−1}| ≤ j_max Δt.
struct ReachProgram {
  int intervals = 6;        ///< J
  double interval_s = 0.2;  ///< Δt
  double v_max = 6.0, a_max = 20.0, j_max = 1e30;
};

/// Returns the smallest and the largest v_{l+1} from which rest can be reached, given v_l and a_{l-1}; nullopt if it
/// cannot be reached.
struct Reach {
  double low, high;
};
std::optional<Reach> next_velocity(const ReachProgram& program, int l, double v, double a_previous);

}  // namespace tern::oracle
