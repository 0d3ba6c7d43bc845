// Cost of plans on the requests of whole flights. Prints percentiles of the whole plan and of the first answer, the
// share of each stage, and the most expensive requests. Thread CPU time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "core/world/names.h"
#include "planner/plan_workspace.h"
#include "runtime/command_line.h"
#include "runtime/stopwatch.h"

namespace tern {
namespace {

/// Thread CPU time.
struct Spent {
  double total_ms = std::numeric_limits<double>::infinity();
  double first_ms = -1.0;  ///< until the first new trajectory
  std::array<double, kStages> stage_ms{};
};

class CpuObserver final : public PlanObserver {
 public:
  void enter(Stage stage) override {
    close();
    stage_ = stage;
  }
  void answer(const Plan& plan) override {
    const bool is_new = plan.outcome != PlanOutcome::KeepCommitted && plan.outcome != PlanOutcome::NoPlan;
    if (is_new && spent_.first_ms < 0.0) spent_.first_ms = thread_cpu_ms() - begin_;
  }
  const Spent& end() {
    close();
    spent_.total_ms = thread_cpu_ms() - begin_;
    if (spent_.first_ms < 0.0) spent_.first_ms = spent_.total_ms;
    return spent_;
  }

 private:
  void close() {
    const double now = thread_cpu_ms();
    spent_.stage_ms[static_cast<std::size_t>(stage_)] += now - since_;
    since_ = now;
  }
  Spent spent_;
  double begin_ = thread_cpu_ms(), since_ = begin_;
  Stage stage_ = Stage::Fallback;
};

struct Cost : Spent {
  std::size_t request = 0;
  PlanAnswer answer;
};

/// Returns the least of `repeats` measurements, to exclude the effect of other load.
Cost cost_of(const Moment& m, const PlannerConfig& config, int repeats, PlanWorkspace& workspace) {
  Cost least;
  for (int k = 0; k < repeats; ++k) {
    Budget budget = Budget::unlimited();
    CpuObserver observer;
    PlanAnswer answer = plan(m.request, m.world, config, budget, workspace, &observer);
    const Spent& spent = observer.end();
    if (spent.total_ms < least.total_ms) least = {spent, 0, std::move(answer)};
  }
  return least;
}

template <class Get>
std::string percentiles(const std::vector<Cost>& costs, const Get& get) {
  std::vector<double> values;
  for (const Cost& c : costs) values.push_back(get(c));
  return percentiles_text(std::move(values));
}

void report(const std::vector<Cost>& costs, int worst) {
  fmt::print("first answer, ms: {}\n", percentiles(costs, [](const Cost& c) { return c.first_ms; }));
  fmt::print("whole plan, ms:   {}\n", percentiles(costs, [](const Cost& c) { return c.total_ms; }));
  double total = 0.0;
  for (const Cost& c : costs) total += c.total_ms;
  for (std::size_t s = 0; s < kStages; ++s) {
    double stage = 0.0;
    for (const Cost& c : costs) stage += c.stage_ms[s];
    fmt::print("{:13} {:5.1f} %  {}\n", key(static_cast<Stage>(s)), 100.0 * stage / total,
               percentiles(costs, [s](const Cost& c) { return c.stage_ms[s]; }));
  }
  std::vector<const Cost*> dearest;
  for (const Cost& c : costs) dearest.push_back(&c);
  std::sort(dearest.begin(), dearest.end(), [](const Cost* a, const Cost* b) { return a->total_ms > b->total_ms; });
  dearest.resize(std::min(dearest.size(), static_cast<std::size_t>(worst)));
  for (const Cost* c : dearest) {
    const PlanStatistics& s = c->answer.statistics;
    const Plan& p = c->answer.plan;
    fmt::print(
        "request {:4} {:7.2f} ms first {:7.2f}: {} reason {} relaxed {} hold {:.2f}; {} expansions, {} hulls, {} "
        "boxes, {} planes\n",
        c->request, c->total_ms, c->first_ms, to_string(p.outcome), static_cast<int>(p.reason), p.relaxed,
        p.hold.seconds(), s.expansions, s.hulls, s.pairs.by_box, s.pairs.by_plane + s.pairs.by_cache);
  }
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app{"Replans the requests of virtual flights and prints their cost, ms of thread CPU time."};
  tern::FlightSelection flights;
  int repeats = 3;
  int worst = 10;
  flights.add_options(app);
  app.add_option("--repeats", repeats, "Measurements per request; the least counts");
  app.add_option("--worst", worst, "How many of the most expensive requests are listed");
  if (const auto code = app.parse(argc, argv, 2)) return *code;
  std::vector<tern::Cost> costs;
  tern::PlanWorkspace workspace;
  flights.each([&](std::int64_t seed, const tern::FlightRecording& flight) {
    std::uint64_t h = 14695981039346656037ULL;
    for (std::size_t k = 0; k < flight.moments.size(); ++k) {
      tern::Cost cost = tern::cost_of(flight.moments[k], flight.config, repeats, workspace);
      cost.request = k;
      const auto& q = cost.answer.plan.trajectory.control_points;
      for (Eigen::Index i = 0; i < q.size(); ++i)
        h = (h ^ std::bit_cast<std::uint64_t>(q.data()[i])) * 1099511628211ULL;
      costs.push_back(std::move(cost));
    }
    fmt::print("seed {}: {} requests, {} in {:.2f} s, answers {:016x}\n", seed, flight.moments.size(),
               to_string(flight.result.outcome), flight.result.flight_time_s, h);
  });
  tern::report(costs, worst);
  return 0;
}
