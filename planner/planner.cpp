#include "planner/planner.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/splines/piecewise_cubic.h"
#include "planner/attempt.h"
#include "planner/duration.h"
#include "planner/evasion.h"
#include "planner/look_ahead.h"
#include "planner/refinement.h"
#include "planner/start_clearance.h"

namespace tern {
namespace {

/// The sphere's border is left to rounding and to MINVO points that bulge: local goals lie this far inside, as a share
/// of r.
constexpr double kLocalGoalShare = 0.985;
/// A path that is longer than the straight line, or cheaper, by no more than this counts as straight, m.
constexpr double kBendIgnored = 0.15;

/// Heads for the farthest corner of the path to which the straight line is hardly shorter: small bends around posts are
/// the search's business, but the way into a window, out of a trap or around a region leads over its corners.
WayToGo way_along(const std::vector<Vec3>& path, const TravelCost& cost, double bend_ignored) {
  std::size_t corner = 1;
  double length = 0.0;
  double along = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    length += (path[k] - path[k - 1]).norm();
    along += cost(path[k - 1], path[k]);
    const bool is_straight = length - (path[k] - path[0]).norm() <= bend_ignored;
    if (k == 1 || (is_straight && cost(path[0], path[k]) - along <= bend_ignored)) corner = k;
  }
  WayToGo way{path[corner], 0.0};
  for (std::size_t k = corner + 1; k < path.size(); ++k) way.rest += (path[k] - path[k - 1]).norm();
  return way;
}

class Planning {
 public:
  Planning(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config,
           const LookAhead& look, Budget& budget, PlanWorkspace& workspace, PlanObserver* observer)
      : request_(request),
        world_(world),
        config_(config),
        look_(look),
        budget_(budget),
        observer_(observer),
        workspace_(workspace),
        obstacles_(workspace.obstacles) {
    name_inputs();
  }

  PlanAnswer run() {
    enter(Stage::Fallback);
    if (!world_.predictions || !world_.map || !world_.goal || stale()) return finish_without(PlanReason::StaleWorld);
    choose_obstacles();
    committed_ = check_committed();
    offer(committed_ ? &*committed_ : nullptr, reason_of_fallback());
    if (idle() && committed_ && committed_->holds && !is_hit_at_rest_) {
      return finish(&*committed_, PlanReason::AtGoal);
    }
    AttemptContext context = make_context();
    const bool has_path = head_for_goal(context);
    if (!has_path) reason_ = PlanReason::GoalBlocked;
    if (answer_.plan.relaxed) gain_clearance(context);
    if (has_path && !best_ && !idle()) try_durations(context);
    for (int k = 0; has_path && stuck(k); ++k) {
      aim(context, context.goal_radius / kSmallerStep);
      try_durations(context);
    }
    if (needs_evasion()) evade(context);
    return choose();
  }

 private:
  void enter(Stage stage) {
    if (observer_ != nullptr) observer_->enter(stage);
  }

  void name_inputs() {
    Plan& p = answer_.plan;
    p.request_id = request_.id;
    p.sphere_radius = config_.sphere_radius_m;
    p.local_goal = request_.start.p;
    p.trajectory = request_.committed;
    p.inputs.request = request_.header.name;
    if (world_.goal) {
      p.inputs.goal = world_.goal->goal.header.name;
      p.inputs.goal_field = world_.goal->made_from;
    }
    if (world_.map) p.inputs.map_version = world_.map->version;
    if (world_.predictions) {
      p.inputs.predictions = world_.predictions->set.header.name;
      p.inputs.prediction_set = world_.predictions->set.batch.set;
      p.inputs.left_out = world_.predictions->set.left_out;
    }
  }

  [[nodiscard]] bool stale() const {
    return (request_.header.utime - world_.predictions->set.made_at).seconds() > config_.stale_after_s;
  }

  /// Tracks and map boxes that can matter; α of those around the start scaled down where it must be.
  void choose_obstacles() {
    const Box region = planning_region(request_, config_);
    obstacles_.clear();
    std::vector<std::int32_t>& found = workspace_.found;
    world_.predictions->index.query(region, found);
    for (const std::int32_t k : found) {
      obstacles_.push_back(world_.predictions->obstacles[static_cast<std::size_t>(k)]);
    }
    world_.map->occupied.query(region, found);
    for (const std::int32_t k : found) {
      obstacles_.push_back(
          {-1 - static_cast<std::int64_t>(k), nullptr, world_.map->occupied.boxes()[static_cast<std::size_t>(k)], 1.0});
    }
    const StartClearance start = clear_start(obstacles_, request_.body, request_.start.p, request_.t_s);
    answer_.plan.relaxed = start.relaxed;
    start_collides_ = start.collides;
    hold_ = hold_demand(request_, config_, obstacles_);
  }

  /// The committed trajectory from t_s on and its end's hold, against this world.
  std::optional<Candidate> check_committed() {
    const TimedSpline& committed = request_.committed;
    const Vec3 end = committed.control_points.col(committed.control_points.cols() - 1);
    std::vector<double>& times = workspace_.times;
    times.assign(1, 0.0);
    std::vector<PowerCubic> pieces;
    if (request_.t_s < committed.end()) {
      const PiecewiseCubic motion = remaining_motion(committed.spline(), committed.start, request_.t_s);
      UTime t = request_.t_s;
      for (const CubicPiece& piece : motion.pieces) {
        pieces.push_back(reparametrized(piece.coefficients, 0.0, piece.duration.seconds()));
        t = t + piece.duration;
        times.push_back((t - request_.t_s).seconds());
      }
    }
    const double moving_s = times.back();
    if (moving_s > look_.followed_s) return std::nullopt;
    const bool rests = pieces.empty();
    const double look_s = rests ? hold_.cap_of_stop(0.0) : hold_.cap(moving_s);
    append_hold(times, kHoldStep, std::min(look_s, look_.followed_s - moving_s));
    SweptObstacles& swept = workspace_.committed;
    swept.assign(obstacles_, request_.body, request_.t_s, times, committed_box(request_));
    CheckReport report = check_separation(pieces, swept);
    count(report.pairs, swept);
    if (!report.ok()) return std::nullopt;
    Candidate c;
    c.outcome = PlanOutcome::KeepCommitted;
    c.trajectory = committed;
    c.certificate = std::move(report.certificate);
    const ClearTime clear = clear_time_at(swept, static_cast<int>(pieces.size()), end, report.pairs);
    if (rests && clear.seconds <= 0.0) return std::nullopt;
    is_hit_at_rest_ = idle() && clear.blocker != nullptr && clear.blocker->is_promised();
    c.hold_s = std::min(clear.seconds, hold_.cap(moving_s));
    c.holds = lasts(c.hold_s, hold_.required(moving_s));
    c.clear_s = moving_s + clear.seconds;
    return c;
  }

  void count(const PairCounts& pairs, const SweptObstacles& swept) {
    answer_.statistics.pairs += pairs;
    answer_.statistics.count(swept);
  }

  /// At rest where it shall be: nothing to do but to stay clear.
  [[nodiscard]] bool idle() const {
    if (request_.t_s < request_.committed.end()) return false;
    if (world_.goal->goal.mode != GoalMode::Go) return true;
    return (request_.start.p - world_.goal->goal.position).norm() <= config_.goal_tolerance_m;
  }

  AttemptContext make_context() {
    Limits reduced = request_.limits;
    reduced.v_max *= config_.velocity_share;
    return {request_,
            config_,
            obstacles_,
            semantics_in_reach(),
            reduced,
            {},
            request_.start.p,
            budget_,
            observer_,
            answer_.statistics,
            workspace_,
            reduced,
            look_,
            kLocalGoalShare * config_.sphere_radius_m,
            hold_};
  }

  /// The fields, if what they cost differs anywhere in the sphere. The mean distance of Eq. 3 differs everywhere.
  [[nodiscard]] const SemanticFields* semantics_in_reach() const {
    const SemanticFields& fields = world_.map->fields;
    if (!config_.semantics) return nullptr;
    const Box sphere = box_around(request_.start.p, Vec3::Constant(config_.sphere_radius_m));
    const bool differs =
        config_.semantic_cost == SemanticCost::MeanDistance ? fields.weighs() : fields.varies_in(sphere);
    return differs ? &fields : nullptr;
  }

  /// The path around static obstacles gives the way to go and the local goal. False: there is no path.
  bool head_for_goal(AttemptContext& context) {
    enter(Stage::LocalGoal);
    const Vec3 at = request_.start.p;
    if (world_.goal->goal.mode != GoalMode::Go) {
      context.way = {at, 0.0};
      return true;
    }
    const auto path = world_.goal->field->path_from(at);
    if (!path) return false;
    path_ = *path;
    aim(context, context.goal_radius);
    return true;
  }

  /// Heads for the local goal at this radius, or nearer.
  void aim(AttemptContext& context, double largest_radius) {
    const LocalAim aim = aim_along(path_, request_.start, context.plan_limits, largest_radius, look_, config_);
    context.goal_radius = aim.radius;
    context.local_goal = aim.goal;
    context.step_s = aim.least_s;
    context.pace = paced(context.plan_limits, (aim.goal - request_.start.p).norm());
    context.way = way_along(path_, world_.goal->field->cost(), kBendIgnored * step_scale(aim.radius));
    answer_.plan.local_goal = context.local_goal;
    if (committed_) committed_->arrival_s = worth_of(context, committed_->trajectory);
  }

  /// At rest on the way to a goal, with no plan for the steps tried so far: a smaller one may find a way.
  [[nodiscard]] bool stuck(int smaller_steps) {
    if (best_ || smaller_steps >= kSmallerSteps || request_.t_s < request_.committed.end() || idle()) return false;
    return world_.goal->goal.mode == GoalMode::Go && !budget_.expired(Stage::LocalGoal);
  }

  /// Too short a duration leaves the goal out of reach, too long a one is slow: a few scales of the least one, each
  /// leaf optimized, the best kept.
  void try_durations(AttemptContext& context) {
    const double least = planned_duration(request_.start, context.local_goal, context.plan_limits);
    const double scale_of_lengths = step_scale(context.goal_radius);
    const SearchConfig search = scaled(config_.search, context.goal_radius, least);
    for (const double scale : config_.duration_scales) {
      if (attempt_ == kFirstEvasionAttempt) break;
      budget_.begin_attempt(attempt_++);
      if (best_ && (enough(kNearLocalGoal * scale_of_lengths) || budget_.expired(Stage::LocalGoal))) break;
      const std::optional<Duration> interval = interval_of(scale * least, config_.intervals);
      if (!interval) break;
      const double end_s = interval->seconds() * config_.intervals;
      if (!is_followed(context, *interval, hold_.cap(end_s))) break;
      enter(Stage::Hulls);
      SweptObstacles& swept = workspace_.horizon;
      sweep_horizon(context, *interval, hold_.cap(end_s), swept);
      auto found = search_candidate(context, swept, *interval, hold_.required(end_s), search);
      if (found) {
        if (!best_ || found->better_than(*best_)) offer(&*found, PlanReason::None);
        take(optimized(context, swept, std::move(*found)));
      }
      answer_.statistics.count(swept);
    }
    if (!best_) reason_ = reason_of_nothing();
  }

  /// A longer duration is not tried when a leaf holds and comes near the local goal.
  [[nodiscard]] bool enough(double near) const { return best_->holds && best_->cost.distance_to_goal <= near; }

  /// The optimizer's trajectory, where it gives up neither the leaf's hold, nor much of its arrival, nor most of its
  /// progress where intervals are short (to who crosses the sphere in a moment, arrivals say little); else the leaf.
  Candidate optimized(AttemptContext& context, SweptObstacles& swept, Candidate leaf) {
    auto smooth = refine(context, swept, leaf);
    if (!smooth || (leaf.holds && !smooth->holds)) return leaf;
    const double progress = progress_of(context, leaf);
    const bool in_a_moment = leaf.trajectory.interval < kMoment;
    if (in_a_moment && progress > 0.0 && progress_of(context, *smooth) < kProgressKept * progress) return leaf;
    return smooth->arrival_s <= leaf.arrival_s + kSmoothnessPrice ? std::move(*smooth) : leaf;
  }

  /// By how much the way to go is shorter at the end, m.
  [[nodiscard]] double progress_of(const AttemptContext& context, const Candidate& candidate) const {
    const Points& q = candidate.trajectory.control_points;
    return context.way.from(request_.start.p) - context.way.from(q.col(q.cols() - 1));
  }

  void take(Candidate candidate) {
    if (best_ && !candidate.better_than(*best_)) return;
    best_ = std::move(candidate);
    offer(&*best_, PlanReason::None);
  }

  [[nodiscard]] bool needs_evasion() const {
    if (best_ && best_->holds) return false;
    return !(committed_ && committed_->holds) || is_hit_at_rest_;
  }

  /// The start lies inside a hull: out of it first, to where there is most room.
  void gain_clearance(AttemptContext& context) {
    best_ = find_evasion(context, EvasionAim::GreatestClearance);
    if (best_) offer(&*best_, PlanReason::None);
  }

  /// The reachable stop that stays clear longest, sought all around the vehicle.
  void evade(AttemptContext& context) {
    auto found = find_evasion(context, EvasionAim::LongestClear);
    if (!found) return;
    const double standing = std::max(best_ ? best_->clear_s : 0.0, committed_ ? committed_->clear_s : 0.0);
    if (found->clear_s <= standing) return;
    best_ = std::move(found);
    offer(&*best_, PlanReason::None);
  }

  /// A vehicle at rest gains nothing by waiting: a plan that gets nearer is flown even if it is estimated to arrive as
  /// late, or later by what smoothness may cost. (Arrivals are counted per axis: where one axis is slow, those of rest
  /// and of a plan that begins gently are equal.)
  [[nodiscard]] bool sets_out() const {
    const bool rests = request_.t_s >= request_.committed.end();
    if (!rests || best_->holds != committed_->holds) return false;
    if (best_->arrival_s > committed_->arrival_s + kSmoothnessPrice) return false;
    return best_->cost.distance_to_goal < (answer_.plan.local_goal - request_.start.p).norm() - kNearer;
  }

  [[nodiscard]] PlanReason reason_of_nothing() const {
    if (start_collides_) return PlanReason::StartInCollision;
    return budget_.cuts().empty() ? PlanReason::Infeasible : PlanReason::OutOfTime;
  }

  [[nodiscard]] PlanReason reason_of_fallback() const {
    return start_collides_ ? PlanReason::StartInCollision : PlanReason::OutOfTime;
  }

  /// Tells the observer of the answer that stands so far.
  void offer(const Candidate* candidate, PlanReason reason) {
    if (observer_ == nullptr) return;
    if (candidate != nullptr && committed_ && candidate != &*committed_ && !candidate->better_than(*committed_)) return;
    observer_->answer(fill(candidate, reason));
  }

  PlanAnswer choose() {
    if (!best_) {
      if (committed_) return finish(&*committed_, reason_);
      return finish_without(reason_ == PlanReason::None ? PlanReason::Infeasible : reason_);
    }
    if (committed_ && best_->outcome != PlanOutcome::Evade && !best_->better_than(*committed_) && !sets_out()) {
      return finish(&*committed_, PlanReason::WorsePlan);
    }
    return finish(&*best_, PlanReason::None);
  }

  Plan fill(const Candidate* candidate, PlanReason reason) {
    Plan plan = answer_.plan;
    plan.reason = reason;
    plan.cuts = budget_.cuts();
    if (candidate == nullptr) {
      plan.outcome = PlanOutcome::NoPlan;
      return plan;
    }
    plan.outcome = candidate->outcome;
    plan.trajectory = candidate->trajectory;
    plan.hold = Duration::from_seconds(candidate->hold_s);
    plan.cost = candidate->cost;
    plan.certificate = candidate->certificate;
    return plan;
  }

  PlanAnswer finish(const Candidate* candidate, PlanReason reason) {
    answer_.plan = fill(candidate, reason);
    return std::move(answer_);
  }
  PlanAnswer finish_without(PlanReason reason) { return finish(nullptr, reason); }

  static constexpr double kNearLocalGoal = 1.0;  // m
  static constexpr int kSmallerSteps = 3;
  static constexpr double kSmallerStep = 3.0;  ///< by this much smaller each
  static constexpr double kProgressKept = 0.5;
  static constexpr double kNearer = 1e-6;  // m
  static constexpr Duration kMoment{40'000};
  static constexpr double kSmoothnessPrice =
      0.05;  // s: an optimized trajectory may arrive so much later than the search's

  const HorizonRequest& request_;
  const PlanningWorld& world_;
  const PlannerConfig& config_;
  const LookAhead look_;
  Budget& budget_;
  PlanObserver* observer_;
  PlanWorkspace& workspace_;
  std::vector<PlanningObstacle>& obstacles_;
  bool start_collides_ = false;
  HoldDemand hold_;
  bool is_hit_at_rest_ = false;  ///< the vehicle rests where it shall, and a motion that is promised comes through it
  std::optional<Candidate> committed_;
  std::optional<Candidate> best_;
  std::vector<Vec3> path_;  ///< to the goal
  int attempt_ = 0;
  PlanReason reason_ = PlanReason::None;
  PlanAnswer answer_;
};

}  // namespace

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanWorkspace& workspace, PlanObserver* observer) {
  const LookAhead look = world.predictions ? look_ahead(request, *world.predictions, config) : LookAhead{};
  const std::optional<PlannerConfig> shorter = with_shorter_holds(config, look);
  return Planning(request, world, shorter ? *shorter : config, look, budget, workspace, observer).run();
}

PlanAnswer plan(const HorizonRequest& request, const PlanningWorld& world, const PlannerConfig& config, Budget& budget,
                PlanObserver* observer) {
  PlanWorkspace workspace;
  return plan(request, world, config, budget, workspace, observer);
}

}  // namespace tern
