#include "planner/heading/heading_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/world/thrust.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kCell = kTurn / kYawCells;

/// In [0, kYawCells).
double in_cells(double yaw) {
  const double turns = yaw * (1.0 / kTurn);
  const double cells = (turns - std::floor(turns)) * kYawCells;
  return cells < kYawCells ? cells : 0.0;
}

/// The cost per second of each yaw at one control point, at the cells' lower edges and linear in between.
class UnseenTable {
 public:
  UnseenTable(const std::vector<LookTarget>& targets, double half_view) {
    for (int k = 0; k < kYawCells; ++k) cost_[idx(k)] = unseen_cost(k * kCell, targets, half_view);
    cost_.back() = cost_.front();
  }
  /// @param cells  of in_cells()
  [[nodiscard]] double at(double cells) const {
    const int k = static_cast<int>(cells);
    const double share = cells - k;
    return (1.0 - share) * cost_[idx(k)] + share * cost_[idx(k + 1)];
  }

 private:
  std::array<double, kYawCells + 1> cost_;  ///< the last one is the first
};

/// A spline up to the control point q_{i+1} and its rate w_i.
struct State {
  double cost = 0.0, yaw = 0.0, rate = 0.0;
  int level = 0;    ///< the rate in steps of the grid
  int parent = -1;  ///< index in the layer before
};

/// The cheapest state of each cell and level.
class Layer {
 public:
  Layer(int levels, std::vector<int>& slots) : levels_(levels), slots_(slots) {
    slots_.assign(idx(kYawCells * (2 * levels + 1)), -1);
  }
  /// @param cells  in_cells() of the state's yaw
  void offer(const State& state, double cells) {
    int& slot = slots_[idx(static_cast<int>(cells) * (2 * levels_ + 1) + state.level + levels_)];
    if (slot < 0) {
      slot = static_cast<int>(states.size());
      states.push_back(state);
    } else if (state.cost < states[idx(slot)].cost) {
      states[idx(slot)] = state;
    }
  }
  std::vector<State> states;

 private:
  int levels_;
  std::vector<int>& slots_;
};

/// Steps and largest level of the rates. 2·steps_per_half levels are the change within one interval.
struct RateGrid {
  double step;         ///< rad/s
  int steps_per_half;  ///< steps in α_max Δt / 2
  int levels;          ///< largest level

  RateGrid(double rate_max, double half_change, double reachable) {
    steps_per_half = std::max(1, static_cast<int>(std::ceil(half_change / (rate_max / kRateSteps))));
    step = half_change / steps_per_half;
    levels = static_cast<int>(std::floor(std::min(rate_max, reachable) / step + 1e-9));
  }
};

std::vector<double> points_to(const std::vector<std::vector<State>>& layers, std::size_t last, double q0) {
  std::vector<double> points(layers.size() + 2);
  points.front() = q0;
  std::size_t at = last;
  for (std::size_t k = layers.size(); k-- > 0;) {
    points[k + 1] = layers[k][at].yaw;
    at = idx(std::max(0, layers[k][at].parent));
  }
  points.back() = points[points.size() - 2];
  return points;
}

}  // namespace

double unseen_cost(double yaw, const std::vector<LookTarget>& targets, double half_view) {
  double cost = 0.0;
  for (const LookTarget& target : targets) {
    const double half = target.half_view > 0.0 ? target.half_view : half_view;
    const double off = std::abs(std::remainder(target.bearing - yaw, kTurn)) / half;
    cost += target.worth * (off <= 1.0 ? off * off : 1.0 + kBeyondView * (off - 1.0));
  }
  return cost;
}

double rate_span(int i, int intervals, double interval_s) {
  return std::min({i + 1, intervals + 2 - i, 3}) * interval_s / 3.0;
}

std::optional<std::vector<double>> search_heading(const HeadingStart& start, Duration interval,
                                                  const std::vector<std::vector<LookTarget>>& targets,
                                                  const HeadingLimits& limits) {
  const double dt = interval.seconds();
  const int intervals = static_cast<int>(targets.size()) - 3;
  const double rate_max = to_radians(limits.rate_max_deg_s), half_view = to_radians(0.5 * limits.view_deg);
  const double half_change = 0.5 * dt * to_radians(limits.acceleration_max_deg_s2);
  const double rate = (start.q1 - start.q0) / rate_span(0, intervals, dt);
  if (std::abs(rate) > rate_max * (1.0 + kLimitTolerance)) return std::nullopt;
  const RateGrid grid(rate_max, half_change, std::abs(rate) + 2.0 * half_change * intervals);
  std::vector<std::vector<State>> layers{{State{.yaw = start.q1, .rate = rate}}};
  std::vector<int> slots;
  for (int i = 1; i <= intervals; ++i) {
    const double span = rate_span(i, intervals, dt), change = i == 1 ? half_change : 2.0 * half_change;
    const UnseenTable unseen(targets[idx(i + 1)], half_view);
    Layer next(grid.levels, slots);
    const std::vector<State>& now = layers.back();
    for (std::size_t k = 0; k < now.size(); ++k) {
      const State& s = now[k];
      const int lowest = std::max(-grid.levels, static_cast<int>(std::ceil((s.rate - change) / grid.step - 1e-9)));
      const int highest = std::min(grid.levels, static_cast<int>(std::floor((s.rate + change) / grid.step + 1e-9)));
      for (int level = lowest; level <= highest; ++level) {
        const double w = level * grid.step, yaw = s.yaw + w * span, cells = in_cells(yaw);
        const double cost = s.cost + span * (unseen.at(cells) + kTurnCost * w * w);
        next.offer({cost, yaw, w, level, static_cast<int>(k)}, cells);
      }
    }
    layers.push_back(std::move(next.states));
  }
  const UnseenTable at_end(targets.back(), half_view);
  const std::vector<State>& last = layers.back();
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < last.size(); ++k) {
    if (std::abs(last[k].level) > grid.steps_per_half) continue;
    const double cost = last[k].cost + rate_span(intervals + 1, intervals, dt) * at_end.at(in_cells(last[k].yaw));
    if (cost < least) {
      least = cost;
      best = k;
    }
  }
  if (!best) return std::nullopt;
  return points_to(layers, *best, start.q0);
}

}  // namespace tern
