#include "planner/global_path/goal_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/global_path/goal_search.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the least spacing ≥ options.resolution for which the region has at most max_nodes.
double affordable_step(const Box& region, const GoalFieldOptions& options) {
  double step = options.resolution;
  const auto nodes = [&] { return ((region.sizes() / step).array() + 2.0).prod(); };
  while (nodes() > static_cast<double>(options.max_nodes)) step *= 1.02;
  return step;
}

}  // namespace

GoalField GoalField::build(std::vector<Box> inflated_statics, const Box& flight_box, const Vec3& goal,
                           const GoalFieldOptions& options) {
  GoalField field;
  field.goal_ = goal;
  field.flight_box_ = flight_box;
  field.cost_ = options.cost;
  std::erase_if(inflated_statics, [&](const Box& box) { return box.isEmpty() || !box.intersects(flight_box); });
  field.obstacles_ = BoxIndex(std::move(inflated_statics));
  field.goal_free_ = flight_box.contains(goal) && !field.obstacles_.covers(goal);
  if (!field.goal_free_) return field;
  field.lay_grid(options);
  GoalSearch search(field.grid_, field.obstacles_, goal, field.cost_);
  search.run();
  field.to_go_ = std::move(search.to_go);
  field.next_ = std::move(search.next);
  field.drift_ = std::move(search.drift);
  return field;
}

void GoalField::lay_grid(const GoalFieldOptions& options) {
  Box region(goal_);
  if (options.start) region.extend(*options.start);
  for (const Box& box : obstacles_.boxes()) region.extend(box.intersection(flight_box_));
  const Box weighed = cost_.region.intersection(flight_box_);
  if (!weighed.isEmpty()) region.extend(weighed);
  region = grown(region, Vec3::Constant(options.margin)).intersection(flight_box_);
  const double step = affordable_step(region, options);
  for (int i = 0; i < 3; ++i) {
    grid_.axis[i] = GridAxis(region.min()[i], region.max()[i], step, options.anchor[i]);
  }
  open_gaps(step);
}

void GoalField::open_gaps(double step) {
  for (int i = 0; i < 3; ++i) {
    const GridAxis& axis = grid_.axis[i];
    std::vector<std::pair<double, double>> gaps;  // (−width, middle)
    const auto note = [&](double from, double to) {
      const double width = to - from;
      if (width <= 4.0 * kPathClearance || width >= 2.0 * step) return;
      if (!axis.has_line_between(from + 0.2 * width, to - 0.2 * width)) gaps.emplace_back(-width, 0.5 * (from + to));
    };
    for (const Box& box : obstacles_.boxes()) {
      Box above = box;
      above.min()[i] = box.max()[i];
      above.max()[i] = box.max()[i] + 2.0 * step;
      obstacles_.visit(above, [&](std::int32_t k) {
        note(box.max()[i], obstacles_.boxes()[idx(k)].min()[i]);
        return false;
      });
      note(axis.low(), box.min()[i]);
      note(box.max()[i], axis.high());
    }
    // The widest gaps first, and at most a quarter of the existing lines: gaps must not make the grid explode.
    std::sort(gaps.begin(), gaps.end());
    gaps.erase(std::unique(gaps.begin(), gaps.end()), gaps.end());
    gaps.resize(std::min(gaps.size(), static_cast<std::size_t>(8 + axis.size() / 4)));
    std::vector<double> lines;
    lines.reserve(gaps.size());
    for (const auto& gap : gaps) lines.push_back(gap.second);
    grid_.axis[i].add(lines);
  }
}

Vec3 GoalField::position(std::int32_t node) const { return node == kGoalNode ? goal_ : grid_.position(node); }

double GoalField::to_go(std::int32_t node) const { return node == kGoalNode ? 0.0 : to_go_[idx(node)]; }

/// Returns what the way from a point to a turning point adds to the cost of that.
double GoalField::step_cost(const Vec3& from, std::int32_t turn) const {
  if (!cost_.priced) return cost_(from, position(turn));
  Drift drift = turn == kGoalNode ? Drift{} : drift_[idx(turn)];
  return cost_.priced(from, position(turn), drift) - to_go(turn);
}

/// Returns the drift of the way from a vertex of a path; none without a `priced` cost.
Drift GoalField::drift_from(const std::vector<Vec3>& path, std::size_t k) const {
  Drift drift;
  for (std::size_t i = path.size() - 1; cost_.priced && i > k; --i) cost_.priced(path[i - 1], path[i], drift);
  return drift;
}

/// Returns the best first point of a path: a node near the start, or the turning point that such a node sees.
std::int32_t GoalField::first_turn(const Vec3& start) const {
  std::int32_t best = kNoNode;
  double shortest = kInfinity;
  const auto consider = [&](std::int32_t turn) {
    const Vec3 p = position(turn);
    if ((p - start).norm() + to_go(turn) >= shortest) return;
    const double length = step_cost(start, turn) + to_go(turn);
    if (length >= shortest || obstacles_.blocks(start, p, start)) return;
    best = turn;
    shortest = length;
  };
  // In a narrow place the nearest nodes may be hidden: then the next ring of nodes is tried.
  for (int ring = 0; ring <= 2 && best == kNoNode; ++ring) {
    grid_.for_neighbours(grid_.cell(start), ring, ring + 1, [&](std::int32_t node) {
      if (!(to_go(node) < kInfinity)) return;
      consider(next_[idx(node)]);
      consider(node);
    });
  }
  return best;
}

std::optional<std::vector<Vec3>> GoalField::path_from(const Vec3& start) const {
  if (!goal_free_) return std::nullopt;
  const bool sees_goal = !obstacles_.blocks(start, goal_, start);
  if (sees_goal && cost_.is_length()) return std::vector<Vec3>{start, goal_};
  std::int32_t turn = first_turn(start);
  if (sees_goal && (turn == kNoNode || step_cost(start, kGoalNode) <= step_cost(start, turn) + to_go(turn))) {
    return std::vector<Vec3>{start, goal_};
  }
  if (turn == kNoNode) return std::nullopt;
  std::vector<Vec3> path{start, position(turn)};
  while (turn != kGoalNode) {
    turn = next_[idx(turn)];
    path.push_back(position(turn));
  }
  tighten(path);
  return path;
}

std::optional<Box> GoalField::blocker(const Vec3& start) const {
  Vec3 from = goal_, to = goal_;  // ends of the line to the goal
  if (goal_free_) {
    from = start;
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(to_go_.size()); ++node) {
      if (!(to_go(node) < kInfinity)) continue;
      if ((position(node) - start).squaredNorm() < (to - start).squaredNorm()) to = position(node);
    }
  }
  std::optional<Box> first;
  double nearest = kInfinity;
  Box line(from);
  line.extend(to);
  obstacles_.visit(grown(line, Vec3::Constant(kPathClearance)), [&](std::int32_t k) {
    const Box& box = obstacles_.boxes()[idx(k)];
    const double distance = box.exteriorDistance(from);
    const Box core = goal_free_ ? core_beyond(box, start) : box;
    if (!core.isEmpty() && distance < nearest && segment_meets_box(from, to, core)) {
      nearest = distance;
      first = box;
    }
    return false;
  });
  return first;
}

void GoalField::tighten(std::vector<Vec3>& path) const {
  constexpr double kMinPull = 1.0 / (1 << kPullHalvings);
  const Vec3 start = path.front();
  const auto is_free = [&](const Vec3& a, const Vec3& b) { return !obstacles_.blocks(a, b, start); };
  // By length alone, erasing a vertex or pulling it to a chord never makes a path longer.
  Drift beyond;  // of the way from b
  const auto over = [&](const Vec3& a, const Vec3& v, const Vec3& b) {
    if (!cost_.priced) return cost_(a, v) + cost_(v, b);
    Drift drift = beyond;
    cost_.priced(v, b, drift);
    return cost_.priced(a, v, drift);
  };
  const auto is_cheaper = [&](const Vec3& a, const Vec3& v, const Vec3& w, const Vec3& b) {
    return cost_.is_length() || over(a, w, b) <= over(a, v, b);
  };
  for (int pass = 0; pass < kTightenPasses; ++pass) {
    for (std::size_t i = 1; i + 1 < path.size();) {
      const Vec3 a = path[i - 1];
      const Vec3 b = path[i + 1];
      beyond = drift_from(path, i + 1);
      if (is_free(a, b) && is_cheaper(a, path[i], a, b)) {
        path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));
        continue;
      }
      // Pull the vertex towards the chord, then along either of its segments, as far as both stay free: each step
      // shortens.
      const auto pull_to = [&](const Vec3& target) {
        const Vec3 v = path[i];
        const auto reaches = [&](double s) {
          const Vec3 w = v + s * (target - v);
          return is_free(a, w) && is_free(w, b) && is_cheaper(a, v, w, b);
        };
        if (!reaches(kMinPull)) return;
        double free = kMinPull;
        for (int halving = 1; halving <= kPullHalvings; ++halving) {
          const double step = std::ldexp(1.0, -halving);
          if (free + step < 1.0 && reaches(free + step)) free += step;
        }
        path[i] = v + free * (target - v);
      };
      const double along = std::clamp((path[i] - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      pull_to(a + along * (b - a));
      pull_to(a);
      pull_to(b);
      ++i;
    }
  }
}

}  // namespace tern
