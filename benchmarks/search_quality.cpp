// Quality of the search's leaves: the searches of recorded flights, with their defaults, and again with five seconds
// and no other limit.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "planner/plan_workspace.h"
#include "planner/search/semantic_a_star.h"
#include "runtime/command_line.h"
#include "runtime/stopwatch.h"

namespace tern {
namespace {

constexpr double kLongSearchMs = 5000.0;
/// A leaf is good if it makes this share of the progress of the long search.
constexpr double kShare = 0.95;
/// Negligible progress, m.
constexpr double kNegligible = 0.05;

struct Judged {
  double default_ms = 0.0, long_ms = 0.0;
  bool found = false, best_found = false, holds = false, best_holds = false;
  double progress = 0.0, best_progress = 0.0;  ///< cost-to-go at the start minus at the leaf, m
  [[nodiscard]] bool good() const {
    if (!best_found) return true;
    if (!found || (best_holds && !holds)) return false;
    if (holds && !best_holds) return true;
    return progress >= std::min(kShare * best_progress, best_progress - kNegligible);
  }
};

/// Repeats each search of plan() with a long limit. Evasions have other weights and limits; they are skipped.
class Judge final : public PlanObserver {
 public:
  explicit Judge(const PlannerConfig& config) : config_(config.search) {}

  void enter(Stage stage) override {
    if (stage == Stage::Search) began_ = thread_cpu_ms();
  }
  void answer(const Plan&) override {}
  void searched(const SearchProblem& problem, SeparationCache& swept, const SearchResult& found) override {
    Judged j;
    j.default_ms = thread_cpu_ms() - began_;
    if (!judged.empty() && judged.back().found) return;  ///< durations up to the first that gives a leaf
    SearchConfig unlimited = config_;
    unlimited.max_expansions = std::numeric_limits<int>::max();
    unlimited.hold_expansions = std::numeric_limits<int>::max() / 2;
    const double began = thread_cpu_ms();
    Budget budget([&](const BudgetCut&) { return thread_cpu_ms() - began > kLongSearchMs; });
    const SearchResult best = semantic_a_star(problem, unlimited, swept, budget, memory_);
    j.long_ms = thread_cpu_ms() - began;
    const double at_start = problem.cost_to_go.from(problem.start.p);
    j.found = found.found;
    j.best_found = best.found;
    j.holds = lasts(found.hold_s, problem.hold_required_s);
    j.best_holds = lasts(best.hold_s, problem.hold_required_s);
    j.progress = at_start - found.cost_to_go;
    j.best_progress = at_start - best.cost_to_go;
    judged.push_back(j);
  }

  std::vector<Judged> judged;

 private:
  SearchConfig config_;
  SearchMemory memory_;
  double began_ = 0.0;
};

/// Returns the searches towards the goal of every `every`-th request of a flight.
void judge_flight(const FlightRecording& flight, std::size_t every, std::vector<Judged>& all) {
  PlannerConfig config = flight.config;
  config.optimization.method = OptimizationMethod::SearchOnly;
  PlanWorkspace workspace;
  for (std::size_t k = 0; k < flight.moments.size(); k += every) {
    Judge judge(config);
    Budget budget([](const BudgetCut& here) { return here.phase != Phase::Durations; });
    plan(flight.moments[k].request, flight.moments[k].world, config, budget, workspace, &judge);
    all.insert(all.end(), judge.judged.begin(), judge.judged.end());
  }
}

void report(const std::vector<Judged>& all) {
  std::vector<double> ms;
  std::vector<double> long_ms;
  int good = 0;
  int without = 0;
  int with_leaf = 0;
  int missed = 0;
  int not_holding = 0;
  for (const Judged& j : all) {
    ms.push_back(j.default_ms);
    long_ms.push_back(j.long_ms);
    if (!j.best_found) {
      ++without;
      continue;
    }
    ++with_leaf;
    good += j.good() ? 1 : 0;
    missed += j.found ? 0 : 1;
    not_holding += j.found && j.best_holds && !j.holds ? 1 : 0;
  }
  fmt::print("searches {}; in {} of them 5 s find no leaf either\n", all.size(), without);
  fmt::print("within 5 % of the best: {} of {} ({:.1f} %); no leaf: {}; a leaf that does not hold: {}\n", good,
             with_leaf, 100.0 * good / std::max(1, with_leaf), missed, not_holding);
  fmt::print("default, ms: {}\n5 s, ms:     {}\n", percentiles_text(ms), percentiles_text(long_ms));
}

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  tern::CommandLine app{"Compares the searches of virtual flights with searches of five seconds. Thread CPU time."};
  tern::FlightSelection flights;
  std::size_t every = 4;
  flights.add_options(app);
  app.add_option("--every", every, "Judge every n-th request")->positive();
  if (const auto code = app.parse(argc, argv, 2)) return *code;
  std::vector<tern::Judged> all;
  flights.each([&](std::int64_t, const tern::FlightRecording& flight) { tern::judge_flight(flight, every, all); });
  if (all.empty()) return 1;
  tern::report(all);
  return 0;
}
