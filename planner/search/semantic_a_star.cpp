#include "planner/search/semantic_a_star.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/splines/piecewise_cubic.h"
#include "planner/problem/tuning.h"

namespace tern {
namespace {

using Node = SearchNode;
using Entry = SearchEntry;
using AxisSample = SearchAxisSample;

struct Leaf {
  int node = -1;
  bool holds = false;
  std::int64_t band = 0;
  double f = 0.0;
  double hold_s = 0.0;
  [[nodiscard]] bool is_preferred_to(const Leaf& o) const {
    if (o.node < 0) return true;
    if (holds != o.holds) return holds;
    return std::tie(band, f, node) < std::tie(o.band, o.f, o.node);
  }
};

/// The largest number of bands, which fits into an integer.
constexpr double kMaxBands = 1e15;

/// Returns the band of a cost-to-go. Bands have this width; the last one is divided into kFinerBands.
std::int64_t band_of(double cost_to_go, double width) {
  const double bands = std::min(cost_to_go / width, kMaxBands);
  return bands < 1.0 ? static_cast<std::int64_t>(bands * kFinerBands)
                     : kFinerBands - 1 + static_cast<std::int64_t>(bands);
}

/// Returns the band counted from the border of S; the first one is half as wide. Counted from 0, the border would cut a
/// band anywhere, sometimes leaving a millimetre, and the search would expand a whole tree for a leaf in it.
std::int64_t band_from_border(double beyond, double width) { return std::llround(std::min(beyond / width, kMaxBands)); }

/// Returns a lower bound of the cost-to-go of all points of S.
double min_cost_to_go_in_sphere(const SearchProblem& problem) {
  return std::max(0.0, (problem.cost_to_go.point - problem.start.p).norm() - problem.sphere_radius) +
         problem.cost_to_go.rest;
}

class Search {
 public:
  Search(const SearchProblem& problem, const SearchConfig& config, SeparationCache& cache, Budget& budget,
         SearchMemory& memory)
      : problem_(problem),
        config_(config),
        cache_(cache),
        budget_(budget),
        dt_(problem.interval_s()),
        basis_(spline_basis(problem.intervals)),
        min_cost_to_go_(min_cost_to_go_in_sphere(problem)),
        counts_from_border_(problem.plan_limits.dynamics && min_cost_to_go_ > 0.0),
        aim_(problem.cost_to_go.point),
        reach_(memory.reach),
        nodes_(memory.nodes),
        open_(memory.open),
        closed_(memory.closed),
        samples_(memory.samples) {
    nodes_.clear();
    open_.clear();
    closed_.clear();
    reach_.assign(problem);
  }

  SearchResult run() {
    push_root();
    while (!open_.empty()) {
      if (result_.expansions >= config_.max_expansions || budget_.expired(Stage::Search)) break;
      const Entry top = open_.front();
      if (best_.holds && std::pair(top.band, top.f_step) >= std::pair(best_.band, step_of(best_.f))) break;
      if (best_.node >= 0 && result_.expansions >= give_up_at_) break;
      std::pop_heap(open_.begin(), open_.end(), kLater);
      open_.pop_back();
      visit(top);
    }
    if (best_.node >= 0) report();
    return std::move(result_);
  }

 private:
  static constexpr auto kLater = [](const Entry& a, const Entry& b) { return b.before(a); };
  /// Returns f in steps. Of nodes with equal steps the deepest is expanded first, so that the search goes deep.
  [[nodiscard]] std::int64_t step_of(double f) const {
    return static_cast<std::int64_t>(std::floor(f / config_.cost_step_m));
  }
  [[nodiscard]] int leaf_index() const { return problem_.intervals; }  // n − 2 = J
  [[nodiscard]] Node& node(int i) { return nodes_[idx(i)]; }

  void push_root() {
    const Points3 q = start_control_points(problem_.start, dt_);
    start_ = q;
    Node root;
    root.q = q.col(2);
    root.v = problem_.start.v + problem_.start.a * (0.5 * dt_);  // v_1
    root.a = problem_.start.a;
    root.l = 2;
    root.g = config_.lambda_g * ((q.col(1) - q.col(0)).norm() + (q.col(2) - q.col(1)).norm());
    add(root, ahead_of(root.l, root.v));
  }

  /// Returns a box of the displacements from q_l to the end, for a given v_{l−1}.
  [[nodiscard]] Box ahead_of(int l, const Vec3& v) const {
    Vec3 low;
    Vec3 high;
    for (int axis = 0; axis < 3; ++axis) {
      const AxisReach::Interval d = reach_.displacement(axis, l, v[axis]);
      low[axis] = d.low;
      high[axis] = d.high;
    }
    return {low, high};
  }

  /// Returns the best band that a leaf in the box may have.
  [[nodiscard]] std::int64_t band_within(const Box& reachable) const {
    const double cost_to_go = std::max(problem_.cost_to_go.from(reachable), min_cost_to_go_);
    return counts_from_border_ ? band_from_border(cost_to_go - min_cost_to_go_, config_.band_m)
                               : band_of(cost_to_go, config_.band_m);
  }

  /// @param ahead  ahead_of() the node
  void add(const Node& n, const Box& ahead) {
    const Box reachable(n.q + ahead.min(), n.q + ahead.max());
    double f = n.g + config_.lambda_h * problem_.cost_to_go.from(n.q);
    if (problem_.pointwise) f += problem_.pointwise(n.q);
    open_.push_back({band_within(reachable), step_of(f), f, leaf_index() - n.l, static_cast<int>(nodes_.size())});
    std::push_heap(open_.begin(), open_.end(), kLater);
    nodes_.push_back(n);
  }

  void visit(const Entry& entry) {
    const Node n = node(entry.node);
    const bool may_close = n.l > 2;
    const std::uint64_t place = may_close ? key(n) : 0;
    if ((may_close && closed_.contains(place)) || !interval_clear(entry.node, n)) return;
    if (problem_.keep_nodes) keep(entry.node, n);
    if (n.l == leaf_index()) return consider_leaf(entry, n);
    if (may_close) closed_.insert(place);
    expand(entry.node, n);
    ++result_.expansions;
  }

  void keep(int index, const Node& n) {
    kept_.resize(nodes_.size(), -1);
    kept_[idx(index)] = static_cast<std::int32_t>(result_.nodes.size());
    result_.nodes.push_back({n.q, n.parent < 0 ? -1 : kept_[idx(n.parent)]});
  }

  /// Returns q_{l−3} … q_l, the control points of interval l − 3.
  [[nodiscard]] Points4 window(int index) {
    Points4 q;
    int i = index;
    for (int k = 3; k >= 0; --k) {
      const Node& n = node(i);
      if (n.l <= 2) {
        q.leftCols(k + 1) = start_.middleCols(2 - k, k + 1);
        break;
      }
      q.col(k) = n.q;
      i = n.parent;
    }
    return q;
  }

  bool interval_clear(int index, const Node& n) {
    if (n.l < 3) return true;
    Points4 q = window(index);
    if (!curve_clear(n.l - 3, q)) return false;
    if (n.l < leaf_index()) return true;
    for (int closing = 1; closing <= 2; ++closing) {
      q.leftCols<3>() = Points3(q.rightCols<3>());
      q.col(3) = n.q;
      if (!curve_clear(n.l - 3 + closing, q)) return false;
    }
    return true;
  }

  bool curve_clear(int j, const Points4& q) {
    const Points4 minvo = q * basis_.position_minvo(j);
    const double r2 = problem_.sphere_radius * problem_.sphere_radius;
    if ((minvo.colwise() - problem_.start.p).colwise().squaredNorm().maxCoeff() > r2) return false;
    const PowerCubic power = q * basis_.power(j);
    const Box hull(minvo.rowwise().minCoeff(), minvo.rowwise().maxCoeff());
    if (!problem_.centre_box.contains(hull) && !problem_.centre_box.contains(cubic_bounds(power, 0.0, 1.0)))
      return false;
    const HullForm form{problem_.hull_basis, problem_.intervals};
    const Points4 points = form.basis == HullBasis::Minvo ? minvo : form.points(j, power, 0.0, 1.0);
    return is_separated(cache_, j, power, points, result_.pairs, form);
  }

  void consider_leaf(const Entry& entry, const Node& n) {
    Leaf leaf{entry.node, false, entry.band, entry.f, 0.0};
    leaf.hold_s = clear_time_at(cache_, problem_.intervals, n.q, result_.pairs).seconds;
    leaf.holds = lasts(leaf.hold_s, problem_.hold_required_s);
    if (best_.node < 0) give_up_at_ = result_.expansions + config_.hold_expansions;
    if (leaf.is_preferred_to(best_)) best_ = leaf;
  }

  void expand(int index, const Node& n) {
    StepReach::Steps steps = reach_.from(n.l - 1, n.v, n.a);
    std::array<AxisReach::Interval, 3>& range = steps.range;
    for (int axis = 0; axis < 3; ++axis) {
      if (n.l == 2) bound_first_peak(axis, range[idx(axis)]);
      if (range[idx(axis)].empty()) return;
    }
    if (n.l == 2) aim_within_sphere(n, range);
    const Vec3 aimed = aimed_velocity(n, range);
    add_child(index, n, steps, aimed, ahead_of(n.l + 1, aimed));
    const std::array<int, 3> samples{config_.samples_xy, config_.samples_xy, config_.samples_z};
    for (int axis = 0; axis < 3; ++axis) sample_axis(axis, n.l + 1, range[idx(axis)], samples[idx(axis)]);
    for (const AxisSample& x : samples_[0]) {
      for (const AxisSample& y : samples_[1]) {
        for (const AxisSample& z : samples_[2]) {
          const Box ahead(Vec3(x.ahead.low, y.ahead.low, z.ahead.low), Vec3(x.ahead.high, y.ahead.high, z.ahead.high));
          add_child(index, n, steps, {x.v, y.v, z.v}, ahead);
        }
      }
    }
  }

  /// Samples the velocities of one axis, which many children share.
  void sample_axis(int axis, int l, const AxisReach::Interval& range, int count) {
    std::vector<AxisSample>& samples = samples_[idx(axis)];
    samples.clear();
    for (int k = 0; k < count; ++k) {
      const double v = range.low + (range.high - range.low) * k / (count - 1);
      samples.push_back({v, reach_.displacement(axis, l, v)});
    }
  }

  /// If the start drives v_1 beyond the limit, the velocity's peak inside interval 0 depends on v_2. With the Bézier
  /// velocities c_k = v_0, v_1, (v_1 + v_2)/2 and b_k = v_max − c_k it is within v_max exactly if b_2 ≥ b_1²/b_0.
  void bound_first_peak(int axis, AxisReach::Interval& v2) const {
    const double limit = problem_.limits.v_max[axis];
    for (const double sign : {1.0, -1.0}) {
      const double v1 = sign * (problem_.start.v[axis] + 0.5 * dt_ * problem_.start.a[axis]);
      if (v1 <= limit) continue;
      const double b0 = std::max(limit - sign * problem_.start.v[axis], 1e-12);
      const double most = 2.0 * (limit - (v1 - limit) * (v1 - limit) / b0) - v1;
      if (sign > 0.0) v2.high = std::min(v2.high, most);
      if (sign < 0.0) v2.low = std::max(v2.low, -most);
    }
  }

  [[nodiscard]] bool in_sphere(const Vec3& q) const {
    return (q - problem_.start.p).squaredNorm() <= problem_.sphere_radius * problem_.sphere_radius;
  }

  /// Returns whether the steps of neighbouring samples end farther apart than the radius of S.
  [[nodiscard]] bool steps_are_wider_than_sphere(const std::array<AxisReach::Interval, 3>& range) const {
    const auto apart = [&](int axis, int samples) {
      const AxisReach::Interval& r = range[idx(axis)];
      return (r.high - r.low) / (samples - 1) * dt_;
    };
    const double widest =
        std::max({apart(0, config_.samples_xy), apart(1, config_.samples_xy), apart(2, config_.samples_z)});
    return widest > problem_.sphere_radius;
  }

  /// If the goal is outside S and a step may leave S, the aimed children aim at the point where the straight line to
  /// the goal leaves S.
  void aim_within_sphere(const Node& root, const std::array<AxisReach::Interval, 3>& range) {
    const Vec3 to_goal = problem_.cost_to_go.point - problem_.start.p;
    if (in_sphere(problem_.cost_to_go.point)) return;
    const bool is_fine = problem_.interval >= kShortInterval && !steps_are_wider_than_sphere(range);
    if (is_fine && in_sphere(root.q + aimed_velocity(root, range) * dt_)) return;
    aim_ = problem_.start.p + to_goal * (kSphereShare * problem_.sphere_radius / to_goal.norm());
  }

  /// Returns the velocity that leads to aim_ and brakes in time: the remaining way divided by the remaining steps.
  [[nodiscard]] Vec3 aimed_velocity(const Node& n, const std::array<AxisReach::Interval, 3>& range) const {
    const int steps = leaf_index() - n.l;
    const double share = steps == 1 ? 1.0 : steps - 0.5;
    Vec3 v = (aim_ - n.q) / (dt_ * share);
    for (int axis = 0; axis < 3; ++axis) {
      const auto& r = range[idx(axis)];
      v[axis] = std::clamp(v[axis], r.low, r.high);
    }
    return v;
  }

  /// @param ahead  ahead_of() the child if its velocity is the wanted one
  void add_child(int index, const Node& n, const StepReach::Steps& steps, const Vec3& wanted, const Box& ahead) {
    const std::optional<Vec3> flyable = reach_.flyable(steps, wanted);
    if (!flyable) return;
    const Vec3& v = *flyable;
    Node child;
    child.q = n.q + v * dt_;
    if (!in_sphere(child.q)) return;
    if (!problem_.centre_box.contains(child.q)) return;
    child.v = v;
    child.a = (v - n.v) / dt_;
    child.parent = index;
    child.l = n.l + 1;
    child.g = n.g + config_.lambda_g * (child.q - n.q).norm();
    if (problem_.accumulated) child.g += problem_.accumulated(n.q, child.q);
    add(child, v == wanted ? ahead : ahead_of(child.l, v));
  }

  /// Returns position, index and coarse velocity as one key. A key is closed only after its node has passed the
  /// collision test, so that a blocked node does not close the only way.
  [[nodiscard]] std::uint64_t key(const Node& n) const {
    const Vec3 p = (n.q - problem_.start.p) / config_.prune_position_m;
    const Vec3 v = n.v / config_.prune_velocity_mps;
    std::uint64_t k = static_cast<std::uint64_t>(n.l);
    for (int axis = 0; axis < 3; ++axis) {
      k = (k << 12) | (static_cast<std::uint64_t>(std::lround(p[axis]) + 2048) & 0xfffU);
      k = (k << 7) | (static_cast<std::uint64_t>(std::lround(v[axis]) + 64) & 0x7fU);
    }
    return k;
  }

  void report() {
    result_.found = true;
    const Node& leaf = node(best_.node);
    Points q(3, problem_.intervals + 3);
    q.leftCols<3>() = start_;
    for (int i = best_.node; node(i).l > 2; i = node(i).parent) q.col(node(i).l) = node(i).q;
    q.col(problem_.intervals + 1) = leaf.q;
    q.col(problem_.intervals + 2) = leaf.q;
    result_.control_points = q;
    result_.cost_to_go = problem_.cost_to_go.from(leaf.q);
    result_.hold_s = best_.hold_s;
    result_.cost = best_.f;
  }

  const SearchProblem& problem_;
  const SearchConfig& config_;
  SeparationCache& cache_;
  Budget& budget_;
  const double dt_;
  const SplineBasis& basis_;
  const double min_cost_to_go_;    ///< least cost-to-go of all points of S, m
  const bool counts_from_border_;  ///< of bands (docs/planner/search.md)
  Vec3 aim_;                       ///< the point at which one child of each node aims, W
  StepReach& reach_;
  std::vector<Node>& nodes_;
  std::vector<Entry>& open_;
  KeySet& closed_;
  std::array<std::vector<AxisSample>, 3>& samples_;  ///< of the node that is expanded
  Points3 start_;
  std::vector<std::int32_t> kept_;  ///< by node: its index in result_.nodes, or −1
  Leaf best_;
  std::int64_t give_up_at_ = 0;  ///< number of expansions at which the search for a leaf that holds ends
  SearchResult result_;
};

}  // namespace

SearchResult semantic_a_star(const SearchProblem& problem, const SearchConfig& config, SeparationCache& cache,
                             Budget& budget, SearchMemory& memory) {
  return Search(problem, config, cache, budget, memory).run();
}

}  // namespace tern
