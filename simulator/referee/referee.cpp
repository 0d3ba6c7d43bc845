#include "simulator/referee/referee.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace tern {
namespace {

constexpr std::int64_t kStepUs = 10'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

UavSpec with_limits(UavSpec uav, const Limits& limits) {
  uav.limits = limits;
  return uav;
}

}  // namespace

Referee::Referee(const Scenario& scenario, World world, const Limits& judged)
    : uav_(scenario.uav),
      goal_(scenario.uav.goal),
      world_(std::move(world)),
      appearances_(world_),
      timeout_s_(flight_timeout_s(scenario)),
      clearance_(world_, uav_.body),
      limits_(with_limits(uav_, judged), BodyDistance(uav_.body).bounds()),
      measures_(scenario.semantics.regions),
      left_out_(world_.left_out) {}

void Referee::admit(double t_s, const std::function<Vec3(double)>& vehicle) {
  left_out_ += appearances_.admit(world_, t_s, vehicle);
}

std::vector<std::string> Referee::passing_the_start(double from_s) const {
  const BodyDistance distance(uav_.body);
  std::set<std::int64_t> passers;
  const int steps = static_cast<int>(std::ceil(-from_s * 1e6 / kStepUs));
  for (int k = 1; k <= steps; ++k) {
    for (const TrueObstacle& o : true_obstacles(world_, -1e-6 * k * kStepUs)) {
      if (distance(uav_.start - o.position, o.half_extents) < 0.0) passers.insert(o.id);
    }
  }
  std::vector<std::string> names;
  names.reserve(passers.size());
  for (const std::int64_t id : passers) names.push_back(name_of(id));
  return names;
}

void Referee::advance(Duration start, const CubicPiece& piece) {
  if (start != now_ || piece.duration <= Duration{}) {
    throw std::invalid_argument(
        fmt::format("referee: a piece starts at {} us and lasts {} us; it must start at {} us and last longer than 0",
                    start.us, piece.duration.us, now_.us));
  }
  if (!piece.coefficients.allFinite()) throw std::invalid_argument("referee: a piece that is not finite");
  if (outcome_) return;
  FlownPiece flown{piece.coefficients, start.seconds()};
  if (has_stated_velocities_) {
    const double end_s = piece.duration.seconds();
    flown.stated = {sample_cubic(piece.coefficients, 0.0).v, sample_cubic(piece.coefficients, end_s).v, end_s};
  }
  if (last_) limits_.join(*last_, sample_cubic(piece.coefficients, 0.0), start.seconds());
  for (std::int64_t at = 0; at < piece.duration.us && !outcome_; at += kStepUs) {
    const Duration to = start + Duration{std::min(at + kStepUs, piece.duration.us)};
    step(flown, (start + Duration{at}).seconds(), to.seconds());
  }
  now_ = start + piece.duration;
  last_ = sample_cubic(piece.coefficients, piece.duration.seconds());
}

void Referee::step(const FlownPiece& piece, double t0_s, double t1_s) {
  const double last = std::min(t1_s, std::max(timeout_s_, t0_s));
  const auto arrived_s = arrival(piece, t0_s, last);
  double end_s = arrived_s.value_or(last);
  const auto contact = clearance_.advance(piece, t0_s, end_s);
  if (contact) end_s = contact->time_s;
  const auto scrape = map_clearance_ ? map_clearance_->advance(piece, t0_s, end_s) : std::nullopt;
  if (map_clearance_) min_map_clearance_m_ = std::min(min_map_clearance_m_, map_clearance_->min_clearance());
  if (scrape) end_s = scrape->time_s;
  limits_.advance(piece, t0_s, end_s);
  if (goal_ && !first_entry_s_) first_entry_s_ = first_entry(piece, t0_s, end_s, *goal_);
  measures_.advance(piece, t0_s, end_s, arrived_s && !contact && !scrape);
  if (scrape || contact) ++(piece.velocity(end_s).norm() > kRestSpeed ? contacts_moving_ : contacts_at_rest_);
  if (scrape) return end(FlightOutcome::Collision, end_s, describe(*scrape, "the map", piece.at(end_s).p));
  if (contact) return end(FlightOutcome::Collision, end_s, describe(*contact, name_of(contact->id), piece.at(end_s).p));
  if (arrived_s && limits_.violations() == 0) return end(FlightOutcome::Reached, end_s, {});
  if (arrived_s) {
    return end(FlightOutcome::Failed, end_s,
               fmt::format("arrived, but left its limits {} times, first: {}", limits_.violations(), limits_.first()));
  }
  if (last >= timeout_s_) end(FlightOutcome::Timeout, end_s, describe_timeout(piece.at(end_s).p));
}

std::optional<double> Referee::arrival(const FlownPiece& piece, double t0_s, double t1_s) const {
  const double from_s = std::max(t0_s, earliest_arrival_s_);
  if (!goal_ || from_s > t1_s) return std::nullopt;
  return first_arrival(piece, from_s, t1_s, *goal_);
}

void Referee::set_goal(const std::optional<Vec3>& goal) {
  if (goal == goal_) return;
  goal_changed_ = goal_changed_ || (goal_ && now_ > Duration{});
  goal_ = goal;
  first_entry_s_.reset();
}

void Referee::end(FlightOutcome outcome, double t_s, std::string detail) {
  outcome_ = outcome;
  end_s_ = t_s;
  detail_ = std::move(detail);
}

std::string Referee::name_of(std::int64_t obstacle) const {
  const std::string& name = world_.obstacles[idx(obstacle)].spec().name;
  return fmt::format("obstacle {}{}", obstacle, name.empty() ? std::string() : fmt::format(" '{}'", name));
}

std::string Referee::describe(const Contact& contact, const std::string& what, const Vec3& p) const {
  const char* how = contact.time_s > 0.0 ? "touched" : "the start lies in";
  return fmt::format("{} {} at {:.3f} s, position ({:.3f}, {:.3f}, {:.3f}) m", how, what, contact.time_s, p.x(), p.y(),
                     p.z());
}

Result<void> Referee::set_map(const std::vector<Box>& occupied) {
  World map;
  for (const Box& box : occupied) {
    ObstacleSpec spec;
    spec.centre = box.center();
    spec.half_extents = 0.5 * box.sizes();
    auto obstacle = WorldObstacle::make(static_cast<std::int64_t>(map.obstacles.size()), std::move(spec));
    if (!obstacle) return tl::unexpected(obstacle.error());
    map.obstacles.push_back(std::move(*obstacle));
  }
  map_clearance_.reset();
  map_ = std::move(map);
  if (!occupied.empty()) map_clearance_.emplace(map_, uav_.body);
  return {};
}

std::string Referee::describe_timeout(const Vec3& p) const {
  if (!goal_) return fmt::format("no goal was set within {:.2f} s", timeout_s_);
  return fmt::format("{:.2f} m from the goal after {:.2f} s", (p - *goal_).norm(), timeout_s_);
}

std::optional<FlightResult> Referee::verdict() const {
  if (!outcome_) return std::nullopt;
  return result_so_far();
}

std::int64_t Referee::obstacles_met() const {
  const double until = outcome_ ? end_s_ : now_.seconds();
  return std::count_if(world_.obstacles.begin(), world_.obstacles.end(),
                       [&](const WorldObstacle& o) { return o.first_s() <= until && o.last_s() >= 0.0; });
}

FlightResult Referee::result_so_far() const {
  FlightResult result;
  result.outcome = outcome_.value_or(FlightOutcome::Failed);
  result.detail = outcome_ ? detail_ : "the flight has not ended";
  result.flight_time_s = outcome_ ? end_s_ : now_.seconds();
  result.first_entry_s = first_entry_s_.value_or(kNaN);
  result.path_length_m = measures_.path_length_m();
  result.mean_speed_mps = kNaN;
  if (outcome_ == FlightOutcome::Reached && end_s_ > 0.0 && !goal_changed_) {
    result.mean_speed_mps = (*goal_ - uav_.start).norm() / end_s_;
  }
  result.top_speed_mps = measures_.top_speed_mps();
  result.min_clearance_m = std::isfinite(clearance_.min_clearance()) ? clearance_.min_clearance() : kNaN;
  result.min_map_clearance_m = std::isfinite(min_map_clearance_m_) ? min_map_clearance_m_ : kNaN;
  result.jerk_integral = measures_.jerk_integral();
  result.stops = measures_.stops();
  result.limit_violations = limits_.violations();
  result.contacts_moving = contacts_moving_;
  result.contacts_at_rest = contacts_at_rest_;
  result.obstacles = obstacles_met();
  result.obstacles_left_out = left_out_;
  result.exposure = measures_.exposure();
  return result;
}

}  // namespace tern
