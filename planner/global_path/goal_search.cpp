#include "planner/global_path/goal_search.h"

#include <limits>

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A way replaces another only if it is shorter by this, m: rounding must not decide.
constexpr double kGain = 1e-9;

}  // namespace

GoalSearch::GoalSearch(const RectilinearGrid& grid, const BoxIndex& obstacles, const Vec3& goal, const TravelCost& cost)
    : to_go(static_cast<std::size_t>(grid.nodes()), kInfinity),
      next(to_go.size(), kNoNode),
      grid_(grid),
      obstacles_(obstacles),
      goal_(goal),
      cost_(cost),
      state_(to_go.size(), State::Open) {
  if (cost.priced) drift.resize(to_go.size());
}

void GoalSearch::run() {
  block_covered_nodes();
  queue_around_goal();
  while (!queue_.empty()) {
    const auto [length, node] = queue_.top();
    queue_.pop();
    const auto n = idx(node);
    if (state_[n] == State::Closed || length != to_go[n]) continue;
    if (state_[n] == State::Open && !sight(node)) continue;
    state_[n] = State::Closed;
    expand(node);
  }
}

void GoalSearch::block_covered_nodes() {
  for (const Box& box : obstacles_.boxes()) {
    const auto [low, high] = grid_.nodes_within(grown(box, Vec3::Constant(kPathClearance)));
    for (int z = low.z(); z < high.z(); ++z) {
      for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) state_[idx(grid_.index({x, y, z}))] = State::Blocked;
      }
    }
  }
}

void GoalSearch::queue_around_goal() {
  grid_.for_neighbours(grid_.cell(goal_), 1, 2, [&](std::int32_t node) {
    const auto n = idx(node);
    if (state_[n] == State::Blocked) return;
    Drift begun;
    to_go[n] = step_cost(grid_.position(node), kGoalNode, begun);
    next[n] = kGoalNode;
    if (!drift.empty()) drift[n] = begun;
    queue_.emplace(to_go[n], node);
  });
}

/// Makes the node see its turning point. @return false if it is queued again with a longer way, or has none
bool GoalSearch::sight(std::int32_t node) {
  const auto n = idx(node);
  const Vec3 p = grid_.position(node);
  if (!obstacles_.blocks(p, position(next[n]))) return true;
  to_go[n] = kInfinity;
  next[n] = kNoNode;
  grid_.for_neighbours(grid_.cell_of(node), 1, 1, [&](std::int32_t other) {
    const auto o = idx(other);
    if (state_[o] != State::Closed) return;
    const Vec3 q = grid_.position(other);
    Drift begun;
    const double length = to_go[o] + step_cost(p, other, begun);
    if (length >= to_go[n] - kGain || obstacles_.blocks(p, q)) return;
    to_go[n] = length;
    next[n] = other;
    if (!drift.empty()) drift[n] = begun;
  });
  if (next[n] == kNoNode) return false;
  if (queue_.empty() || Entry(to_go[n], node) < queue_.top()) return true;
  state_[n] = State::Sighted;
  queue_.emplace(to_go[n], node);
  return false;
}

void GoalSearch::expand(std::int32_t node) {
  const std::int32_t turn = next[idx(node)];
  grid_.for_neighbours(grid_.cell_of(node), 1, 1, [&](std::int32_t other) {
    const auto o = idx(other);
    if (state_[o] == State::Closed || state_[o] == State::Blocked) return;
    offer(other, turn);
    if (!cost_.is_length()) offer(other, node);
  });
}

/// Returns what the step to a turning point adds to its cost, and with a `priced` cost the drift of the way from there.
double GoalSearch::step_cost(const Vec3& from, std::int32_t turn, Drift& drift_there) const {
  if (!cost_.priced) return cost_(from, position(turn));
  drift_there = turn == kGoalNode ? Drift{} : drift[idx(turn)];
  return cost_.priced(from, position(turn), drift_there) - to_go_of(turn);
}

void GoalSearch::offer(std::int32_t other, std::int32_t turn) {
  const auto o = idx(other);
  const Vec3 p = position(turn);
  const Vec3 q = grid_.position(other);
  const double bar = to_go[o] - kGain - to_go_of(turn);
  if ((q - p).norm() >= bar) return;
  Drift begun;
  const double length = step_cost(q, turn, begun);
  if (length >= bar) return;
  to_go[o] = to_go_of(turn) + length;
  next[o] = turn;
  if (!drift.empty()) drift[o] = begun;
  state_[o] = State::Open;
  queue_.emplace(to_go[o], other);
}

}  // namespace tern
