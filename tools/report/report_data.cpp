#include "tools/report/report_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/percentiles.h"
#include "core/scenario/setting.h"
#include "core/world/body.h"
#include "core/world/frames.h"
#include "core/world/names.h"
#include "core/world/replan_samples.h"
#include "core/world/stated_bound.h"
#include "monitor/estimate_watch.h"
#include "runtime/clock.h"
#include "tools/report/map_runs.h"

namespace tern::report {
namespace {

using audit::Audit;
using audit::FlightRecord;
using nlohmann::json;

/// Rounds to millimetres and milliseconds.
double rounded(double x) { return std::round(x * 1e3) / 1e3; }

json row(const Vec3& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

/// Columns of equal length that are filled together.
struct Columns {
  std::vector<std::pair<const char*, json>> all;

  explicit Columns(std::initializer_list<const char*> names) {
    for (const char* name : names) all.emplace_back(name, json::array());
  }
  void add(std::initializer_list<double> values) {
    auto column = all.begin();
    for (const double value : values) {
      column->second.push_back(std::isfinite(value) ? json(rounded(value)) : json());
      ++column;
    }
  }
  [[nodiscard]] json take() {
    json object = json::object();
    for (auto& [name, values] : all) object[name] = std::move(values);
    return object;
  }
};

/// Seconds and metres inside each region so far.
class ExposureSoFar {
 public:
  explicit ExposureSoFar(const FlightRecord& record) : regions_(record.regions), metres_(regions_.size(), 0.0) {}

  void advance(const UavState& state) {
    for (std::size_t k = 0; k < regions_.size() && last_ != nullptr; ++k) {
      if (audit::distance_to(regions_[k], state.motion.p) <= 0.0)
        metres_[k] += (state.motion.p - last_->motion.p).norm();
    }
    last_ = &state;
  }
  [[nodiscard]] const std::vector<double>& metres() const { return metres_; }

 private:
  const std::vector<Region>& regions_;
  std::vector<double> metres_;
  const UavState* last_ = nullptr;
};

json path_of(const FlightRecord& record, const Audit& audit) {
  const std::size_t share = std::max<std::size_t>(1, (record.states.size() + kMaxPathPoints - 1) / kMaxPathPoints);
  Columns columns{"t",         "x",   "y",   "z", "speed", "axis_speed", "acceleration", "axis_acceleration",
                  "clearance", "off", "tube"};
  json exposure = json::array();
  for (std::size_t k = 0; k < record.regions.size(); ++k) exposure.push_back(json::array());
  ExposureSoFar so_far(record);
  std::size_t point = 0, in_tube = 0;
  for (std::size_t from = 0; from < record.states.size(); from += share) {
    const std::size_t to = std::min(from + share, record.states.size());
    double speed = 0.0, axis_speed = 0.0, acceleration = 0.0, axis_acceleration = 0.0, clearance = INFINITY;
    audit::TubePoint edge{.at = {}, .off_m = NAN, .tube_m = NAN};
    for (std::size_t k = from; k < to; ++k) {
      const UavState& s = record.states[k];
      so_far.advance(s);
      speed = std::max(speed, s.motion.v.norm());
      axis_speed = std::max(axis_speed, s.motion.v.cwiseAbs().maxCoeff());
      acceleration = std::max(acceleration, s.motion.a.norm());
      axis_acceleration = std::max(axis_acceleration, s.motion.a.cwiseAbs().maxCoeff());
      while (point < audit.clearance.size() && audit.clearance[point].at < s.at) ++point;
      if (point < audit.clearance.size() && audit.clearance[point].at == s.at) {
        clearance = std::min(clearance, audit.clearance[point].clearance_m);
      }
      for (; in_tube < audit.tube.size() && audit.tube[in_tube].at <= s.at; ++in_tube) {
        const audit::TubePoint& seen = audit.tube[in_tube];
        if (!(edge.tube_m - edge.off_m <= seen.tube_m - seen.off_m)) edge = seen;
      }
    }
    const UavState& first = record.states[from];
    const Vec3& p = first.motion.p;
    columns.add({record.seconds(first.at), p.x(), p.y(), p.z(), speed, axis_speed, acceleration, axis_acceleration,
                 clearance, edge.off_m, edge.tube_m});
    for (std::size_t k = 0; k < so_far.metres().size(); ++k) exposure[k].push_back(rounded(so_far.metres()[k]));
  }
  json path = columns.take();
  path["exposure"] = std::move(exposure);
  path["share"] = share;
  return path;
}

/// Returns the share of time in which the true position was within the stated 99 % ellipsoid, as the summary has it;
/// null without ODOMETRY of a flying vehicle.
json coverage_of(const FlightRecord& record) {
  const UTime end = record.results.empty() ? UTime{INT64_MAX} : record.results.front().header.utime;
  EstimateWatch watch;
  auto truth = record.states.begin();
  for (const Odometry& odometry : record.odometry) {
    if (odometry.at > end) break;
    for (; truth != record.states.end() && truth->at <= std::min(odometry.at, end); ++truth) watch.add_truth(*truth);
    watch.add(odometry);
  }
  if (truth != record.states.end() && truth->at <= end) watch.add_truth(*truth);
  const auto measures = watch.measures(Vec3::Zero());
  return measures ? json(measures->coverage) : json();
}

/// The error of ODOMETRY's position in W against VEHICLE_TRUTH, and the bound that it states: √(χ²(3, 0.99) λ_max(Σ)).
json estimate_of(const FlightRecord& record) {
  const std::size_t share = std::max<std::size_t>(1, (record.odometry.size() + kMaxPathPoints - 1) / kMaxPathPoints);
  Columns columns{"t", "error", "bound", "tracks", "rejected", "x", "y", "z"};
  for (std::size_t k = 0; k < record.odometry.size(); k += share) {
    const Odometry& odometry = record.odometry[k];
    const auto after = std::ranges::lower_bound(record.states, odometry.at, {}, &UavState::at);
    if (after == record.states.end()) break;
    const double back = (after->at - odometry.at).seconds();
    const Vec3 p = OdometryOffset{odometry.p_WO, odometry.yaw_WO, odometry.epoch}.to_W(PointInO{odometry.p_OB}).xyz;
    columns.add({record.seconds(odometry.at), (p - after->motion.p + back * after->motion.v).norm(),
                 stated_bound(odometry.pose_covariance), static_cast<double>(odometry.tracks),
                 static_cast<double>(odometry.rejected), p.x(), p.y(), p.z()});
  }
  json estimate = columns.take();
  estimate["inside"] = coverage_of(record);
  return estimate;
}

json obstacles_of(const FlightRecord& record) {
  std::size_t samples = 0;
  for (const auto& [id, history] : record.truth) samples += history.moves ? history.samples.size() : 0;
  const std::size_t share = std::max<std::size_t>(1, (samples + kMaxMoverPoints - 1) / kMaxMoverPoints);
  json movers = json::array();
  json statics = json::array();
  for (const auto& [id, history] : record.truth) {
    if (history.samples.empty()) continue;
    const Vec3& half = history.samples.front().half_extents;
    if (!history.moves) {
      statics.push_back({{"id", id}, {"p", row(history.samples.front().p)}, {"half", row(half)}});
      continue;
    }
    Columns columns{"t", "x", "y", "z"};
    for (std::size_t k = 0; k < history.samples.size(); k += share) {
      const auto& s = history.samples[k];
      columns.add({record.seconds(s.at), s.p.x(), s.p.y(), s.p.z()});
    }
    json mover = columns.take();
    mover["id"] = id;
    mover["half"] = row(half);
    movers.push_back(std::move(mover));
  }
  return {{"movers", movers}, {"statics", statics}, {"share", share}};
}

json shape_of(const Region& region) {
  if (const auto* box = std::get_if<Box>(&region.shape)) return {{"min", row(box->min())}, {"max", row(box->max())}};
  if (const auto* ball = std::get_if<BallRegion>(&region.shape)) {
    return {{"centre", row(ball->centre)}, {"radius", rounded(ball->radius)}};
  }
  const auto& prism = std::get<PrismRegion>(region.shape);
  json corners = json::array();
  for (const auto& c : prism.corners) corners.push_back({rounded(c.x()), rounded(c.y())});
  return {{"corners", corners}, {"z", {rounded(prism.z_min), rounded(prism.z_max)}}};
}

json regions_of(const FlightRecord& record) {
  json regions = json::array();
  for (const Region& region : record.regions) {
    json one = shape_of(region);
    one["name"] = region.name;
    one["class"] = region.class_name;
    const auto label = record.class_labels.find(region.class_name);
    one["label"] = label == record.class_labels.end() ? "" : label->second;
    regions.push_back(std::move(one));
  }
  return regions;
}

/// One answer: time of its request, and cost. All times in ms are the system's, as those of PLAN_TIMING.
struct Answer {
  double t = 0.0, deadline_ms = 0.0;
  const Plan* plan = nullptr;
  const PlanTiming* timing = nullptr;
  [[nodiscard]] double total_ms() const { return timing == nullptr ? 0.0 : timing->total_ms; }
};

std::vector<Answer> answers_of(const FlightRecord& record, double pace) {
  // A planner sends one timing per plan. A restarted executor counts its requests from 1 again.
  std::map<MessageName, const PlanTiming*> timings;
  for (const PlanTiming& t : record.timings) timings[t.header.name] = &t;
  std::map<MessageName, const Plan*> plans;
  for (const Plan& plan : record.plans) plans.emplace(plan.inputs.request, &plan);
  std::vector<Answer> answers;
  for (const HorizonRequest& r : record.requests) {
    Answer a{record.seconds(r.header.utime), (r.deadline - r.header.utime).seconds() * 1e3 / pace, nullptr, nullptr};
    if (const auto plan = plans.find(r.header.name); plan != plans.end()) {
      a.plan = plan->second;
      const auto timing = timings.find(a.plan->header.name);
      if (timing != timings.end() && timing->second->request_id == r.id) a.timing = timing->second;
    }
    answers.push_back(a);
  }
  return answers;
}

/// Returns the counts of all answers, also of those that the arrays leave out.
json counts_of(const std::vector<Answer>& answers) {
  std::map<std::pair<int, int>, std::int64_t> counts;  ///< by outcome and reason; −1: unanswered
  std::int64_t from_watchdog = 0;
  for (const Answer& a : answers) {
    ++counts[a.plan == nullptr ? std::pair{-1, 0}
                               : std::pair{static_cast<int>(a.plan->outcome), static_cast<int>(a.plan->reason)}];
    from_watchdog += a.timing != nullptr && a.timing->from_watchdog ? 1 : 0;
  }
  json rows = json::array();
  for (const auto& [what, n] : counts) {
    const auto& [outcome, reason] = what;
    rows.push_back({{"outcome", outcome < 0 ? json() : json(outcome)}, {"reason", reason}, {"answers", n}});
  }
  return {{"requests", answers.size()}, {"from_watchdog", from_watchdog}, {"outcomes", rows}};
}

json answers_to_json(const std::vector<Answer>& answers) {
  const std::size_t share = std::max<std::size_t>(1, (answers.size() + kMaxAnswers - 1) / kMaxAnswers);
  Columns columns{"t", "deadline", "total", "outcome", "reason"};
  std::vector<json> stages(kStages, json::array());
  for (std::size_t from = 0; from < answers.size(); from += share) {
    const auto last = answers.begin() + static_cast<std::ptrdiff_t>(std::min(from + share, answers.size()));
    const Answer& a = *std::max_element(answers.begin() + static_cast<std::ptrdiff_t>(from), last,
                                        [](const Answer& x, const Answer& y) { return x.total_ms() < y.total_ms(); });
    const double outcome = a.plan == nullptr ? NAN : static_cast<double>(a.plan->outcome);
    const double reason = a.plan == nullptr ? NAN : static_cast<double>(a.plan->reason);
    columns.add({a.t, a.deadline_ms, a.timing == nullptr ? NAN : a.timing->total_ms, outcome, reason});
    for (std::size_t k = 0; k < stages.size(); ++k) {
      stages[k].push_back(a.timing == nullptr ? json() : json(rounded(a.timing->stage_ms[k])));
    }
  }
  json result = columns.take();
  result["stages"] = stages;
  result["counts"] = counts_of(answers);
  result["share"] = share;
  return result;
}

/// Returns p50, p95, p99 and the maximum.
json to_json(const Percentiles& p) { return {rounded(p.p50), rounded(p.p95), rounded(p.p99), rounded(p.max)}; }

json costs_of(const FlightRecord& record) {
  ReplanSamples samples;
  for (const PlanTiming& t : record.timings) samples.add(t);
  json costs = json::array();
  const auto add = [&](const char* name, const std::vector<double>& ms) {
    costs.push_back({{"name", name}, {"ms", ms.empty() ? json::array() : to_json(percentiles(ms))}});
  };
  add("whole answer", samples.total);
  add("first certified", samples.first_answer);
  for (std::size_t k = 0; k < kStages; ++k) add(kWords<Stage>[k], samples.stage[k]);
  return costs;
}

json log_of(const FlightRecord& record) {
  json channels = json::array();
  for (const auto& [name, c] : record.contents.channels) {
    channels.push_back({{"name", name},
                        {"messages", c.messages},
                        {"bytes", c.bytes},
                        {"lost", c.lost},
                        {"refused", c.refused_total()}});
  }
  json processes = json::array();
  for (const ConfigurationReport& c : record.configurations) {
    processes.push_back({{"process", c.process}, {"build", c.build_id}, {"platform", c.platform}});
  }
  return {{"channels", channels}, {"processes", processes}};
}

/// Returns the settings of a flight from CONFIGURATION, with their names.
constexpr std::array<std::pair<const char*, const char*>, 8> kSettings = {{{"seed", "seed"},
                                                                           {"world.count", "count"},
                                                                           {"semantics.enabled", "semantics"},
                                                                           {"semantics.lambda_attractive", "λ to"},
                                                                           {"semantics.lambda_repulsive", "λ away"},
                                                                           {"uav.limits.v_max", "v_max"},
                                                                           {"uav.limits.a_max", "a_max"},
                                                                           {"uav.limits.j_max", "j_max"}}};

json flight_of(const FlightRecord& record) {
  json flight = {{"log", record.path}, {"length_s", rounded((record.end() - record.zero()).seconds())}};
  if (!record.requests.empty()) {
    const HorizonRequest& r = record.requests.front();
    flight["v_max"] = row(r.limits.v_max);
    flight["a_max"] = row(r.limits.a_max);
    flight["body_half"] = row(0.5 * body_box(r.body).sizes());
    flight["flight_box"] = {row(r.flight_box.min()), row(r.flight_box.max())};
  }
  if (!record.why.empty()) flight["why"] = record.why;
  if (!record.goals.empty()) flight["goal"] = row(record.goals.back().position);
  if (!record.results.empty()) {
    const FlightResult& r = record.results.back();
    // Unrounded: rounding twice would differ from the summary.
    const auto number = [](double x) { return std::isfinite(x) ? json(x) : json(); };
    flight["result"] = {{"outcome", to_string(r.outcome)},        {"detail", r.detail},
                        {"time_s", number(r.flight_time_s)},      {"path_m", number(r.path_length_m)},
                        {"mean_speed", number(r.mean_speed_mps)}, {"top_speed", number(r.top_speed_mps)},
                        {"clearance", number(r.min_clearance_m)}, {"stops", r.stops},
                        {"violations", r.limit_violations},       {"contacts_moving", r.contacts_moving},
                        {"contacts_at_rest", r.contacts_at_rest}, {"obstacles", r.obstacles},
                        {"left_out", r.obstacles_left_out}};
  }
  for (const ConfigurationReport& c : record.configurations) {
    if (const std::string name = setting(c.yaml, "name"); !name.empty()) flight["scenario"] = name;
    if (flight.contains("settings")) continue;
    for (const auto& [key, words] : kSettings) {
      const std::string value = setting(c.yaml, key);
      const bool has_generator = key != std::string_view("world.count") || value != "0";
      if (!value.empty() && has_generator) flight["settings"].push_back({words, value});
    }
    flight["version"] = c.build_id;
  }
  return flight;
}

}  // namespace

json report_data(const FlightRecord& record, const Audit& audit, const FlightLaunch& launch) {
  json flight = flight_of(record);
  flight["recorded_us"] = WallClock::system_time_us(UTime{record.contents.first_us}, launch.pace);
  if (launch.pace != 1.0) flight["pace"] = launch.pace;
  if (!launch.command.empty()) flight["command"] = launch.command;
  return {{"flight", flight},
          {"path", path_of(record, audit)},
          {"estimate", estimate_of(record)},
          {"obstacles", obstacles_of(record)},
          {"regions", regions_of(record)},
          {"map", map_runs(record, kMaxMapRuns)},
          {"answers", answers_to_json(answers_of(record, launch.pace))},
          {"names", {{"outcomes", kWords<PlanOutcome>}, {"reasons", kWords<PlanReason>}, {"stages", kWords<Stage>}}},
          {"costs", costs_of(record)},
          {"log", log_of(record)},
          {"audit", audit::to_json(audit, record)}};
}

}  // namespace tern::report
