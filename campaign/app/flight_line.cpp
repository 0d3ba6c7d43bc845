#include "campaign/app/flight_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace tern {
namespace {

constexpr const char* kOutcomeNames[] = {"optimized", "search", "keep", "evade", "none"};

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// "p50,p99" of what `get` gives of each answer.
template <class Get>
std::string percentiles(const VirtualFlight& flight, const Get& get) {
  std::vector<double> values;
  for (const PlanTiming& t : flight.timings) values.push_back(get(t));
  return fmt::format("{:.2f},{:.2f}", percentile(values, 0.5), percentile(values, 0.99));
}

std::string percentiles_of(const VirtualFlight& flight, Stage stage) {
  return percentiles(flight, [stage](const PlanTiming& t) { return t.stage_ms[static_cast<int>(stage)]; });
}

/// "name:seconds:metres" inside each region, separated by spaces.
std::string exposure_of(const FlightResult& result) {
  std::string text;
  for (const Exposure& e : result.exposure) {
    text += fmt::format("{}{}:{:.2f}:{:.2f}", text.empty() ? "" : " ", e.region, e.seconds, e.metres);
  }
  return text;
}

}  // namespace

const char* flight_columns() {
  return "seed,outcome,flight_time_s,first_entry_s,top_speed_mps,stops,min_clearance_m,requests,answered_in_time,"
         "optimized,"
         "search_only,keep_committed,evade,no_plan,cpu_p50_ms,cpu_p99_ms,first_p50_ms,first_p99_ms,search_p50_ms,"
         "search_p99_ms,"
         "optimization_p50_ms,optimization_p99_ms,infeasible,start_in_collision,worse_plan,exposure,detail";
}

std::string flight_line(std::int64_t seed, const VirtualFlight& f) {
  const auto reason = [&](PlanReason r) { return f.reasons[static_cast<std::size_t>(r)]; };
  return fmt::format("{},{},{:.3f},{:.3f},{:.2f},{},{:.3f},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},\"{}\"", seed,
                     to_string(f.result.outcome), f.result.flight_time_s, f.result.first_entry_s,
                     f.result.top_speed_mps, f.result.stops, f.result.min_clearance_m, f.executor.requests,
                     f.executor.answered_in_time, f.outcomes[0], f.outcomes[1], f.outcomes[2], f.outcomes[3],
                     f.outcomes[4], percentiles(f, [](const PlanTiming& t) { return t.cpu_ms; }),
                     percentiles(f, [](const PlanTiming& t) { return t.first_answer_ms; }),
                     percentiles_of(f, Stage::Search), percentiles_of(f, Stage::Optimization),
                     reason(PlanReason::Infeasible), reason(PlanReason::StartInCollision),
                     reason(PlanReason::WorsePlan), exposure_of(f.result), f.result.detail);
}

void PlanTracer::on_plan(const Plan& p) {
  const Points& q = p.trajectory.control_points;
  const Vec3 end = q.col(q.cols() - 1);
  const MotionSample& s = request_.start;
  const auto text = [](const Vec3& v) { return fmt::format("{:.2f} {:.2f} {:.2f}", v.x(), v.y(), v.z()); };
  fmt::print(stderr, "{:.3f} p {} v {} {} reason {} lasts {:.2f} ends {} goal {} hold {:.2f}{}\n",
             static_cast<double>(request_.t_s.us) * 1e-6, text(s.p), text(s.v),
             kOutcomeNames[static_cast<int>(p.outcome)], static_cast<int>(p.reason),
             p.trajectory.interval.seconds() * static_cast<double>(q.cols() - 3), text(end), text(p.local_goal),
             p.hold.seconds(), p.relaxed ? " relaxed" : "");
}

}  // namespace tern
