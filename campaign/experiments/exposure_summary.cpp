#include "campaign/experiments/exposure_summary.h"

#include <fmt/format.h>

#include <set>

namespace tern {
namespace {

/// Returns mean and interval of a function of the flights.
template <class Get>
MeanInterval mean_of(const std::vector<const SemanticFlight*>& flights, const Get& get) {
  std::vector<double> numbers;
  numbers.reserve(flights.size());
  for (const SemanticFlight* f : flights) numbers.push_back(get(*f));
  return mean_interval(numbers);
}

const SemanticFlight* without_semantics(const std::vector<SemanticFlight>& flights, const SemanticFlight& with) {
  for (const SemanticFlight& f : flights) {
    const SemanticCase& c = f.flown;
    if (c.method != "off" || c.world != with.flown.world || f.seed != with.seed) continue;
    return f.outcome == FlightOutcome::Reached ? &f : nullptr;
  }
  return nullptr;
}

void compare(ExposureSummary& summary, const std::vector<const SemanticFlight*>& reached,
             const std::vector<SemanticFlight>& all, bool attracts) {
  const double sign = attracts ? 1.0 : -1.0;
  std::vector<double> gained, near, longer, later;
  for (const SemanticFlight* with : reached) {
    const SemanticFlight* off = without_semantics(all, *with);
    if (off == nullptr) continue;
    gained.push_back(sign * (with->exposure.metres - off->exposure.metres));
    near.push_back(sign * (with->exposure.near_metres - off->exposure.near_metres));
    longer.push_back(with->path_length_m - off->path_length_m);
    later.push_back(with->flight_time_s - off->flight_time_s);
  }
  summary.gained_m = mean_interval(gained);
  summary.gained_near_m = mean_interval(near);
  summary.longer_m = mean_interval(longer);
  summary.later_s = mean_interval(later);
}

ExposureSummary summarize(const std::vector<SemanticFlight>& all, const SemanticWorld& world, const std::string& method,
                          double lambda) {
  ExposureSummary s;
  s.world = world.scenario;
  s.method = method;
  s.lambda = lambda;
  std::vector<const SemanticFlight*> reached;
  for (const SemanticFlight& f : all) {
    if (f.flown.world != s.world || f.flown.method != method || f.flown.lambda != lambda) continue;
    ++s.flights;
    if (f.outcome == FlightOutcome::Reached) reached.push_back(&f);
  }
  s.reached = static_cast<int>(reached.size());
  s.inside_m = mean_of(reached, [](const SemanticFlight& f) { return f.exposure.metres; });
  s.inside_s = mean_of(reached, [](const SemanticFlight& f) { return f.exposure.seconds; });
  s.near_m = mean_of(reached, [](const SemanticFlight& f) { return f.exposure.near_metres; });
  s.near_s = mean_of(reached, [](const SemanticFlight& f) { return f.exposure.near_seconds; });
  s.path_length_m = mean_of(reached, [](const SemanticFlight& f) { return f.path_length_m; });
  s.flight_time_s = mean_of(reached, [](const SemanticFlight& f) { return f.flight_time_s; });
  compare(s, reached, all, world.attracts);
  return s;
}

/// Returns "1.23 ± 0.04".
std::string plus_minus(const MeanInterval& m, int digits = 2) {
  return fmt::format("{:.{}f} ± {:.{}f}", m.mean, digits, m.half, digits);
}

}  // namespace

std::vector<ExposureSummary> summarize_exposure(const std::vector<SemanticFlight>& flights) {
  std::vector<ExposureSummary> summaries;
  for (const SemanticWorld& world : semantic_worlds()) {
    for (const SemanticMethod& method : semantic_methods()) {
      std::set<double> lambdas;
      for (const SemanticFlight& f : flights) {
        if (f.flown.world == world.scenario && f.flown.method == method.name) lambdas.insert(f.flown.lambda);
      }
      for (const double lambda : lambdas) summaries.push_back(summarize(flights, world, method.name, lambda));
    }
  }
  return summaries;
}

std::string to_csv(const std::vector<ExposureSummary>& summaries) {
  std::string out = "world,method,lambda,flights,reached";
  for (const char* name : {"inside_m", "inside_s", "near_m", "near_s", "path_length_m", "flight_time_s", "gained_m",
                           "gained_near_m", "longer_m", "later_s"}) {
    out += fmt::format(",{0}_mean,{0}_half_ci95", name);
  }
  out += "\n";
  for (const ExposureSummary& s : summaries) {
    out += fmt::format("{},{},{},{},{}", s.world, s.method, s.lambda, s.flights, s.reached);
    for (const MeanInterval* m : {&s.inside_m, &s.inside_s, &s.near_m, &s.near_s, &s.path_length_m, &s.flight_time_s,
                                  &s.gained_m, &s.gained_near_m, &s.longer_m, &s.later_s}) {
      out += fmt::format(",{:.4f},{:.4f}", m->mean, m->half);
    }
    out += "\n";
  }
  return out;
}

std::string to_markdown(const std::vector<ExposureSummary>& summaries) {
  std::string out =
      "| world | method | λ | reached | inside, m | inside, s | within 1 m, m | within 1 m, s | path, m | flight time, "
      "s "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (const ExposureSummary& s : summaries) {
    out += fmt::format("| {} | {} | {} | {}/{} | {} | {} | {} | {} | {} | {} |\n", s.world, s.method, s.lambda,
                       s.reached, s.flights, plus_minus(s.inside_m), plus_minus(s.inside_s), plus_minus(s.near_m),
                       plus_minus(s.near_s), plus_minus(s.path_length_m), plus_minus(s.flight_time_s));
  }
  out +=
      "\n| world | method | λ | exposure gained, m | within 1 m, m | longer path, m | later, s | gained per metre of "
      "longer path |\n|---|---|---|---|---|---|---|---|\n";
  for (const ExposureSummary& s : summaries) {
    if (s.method == "off") continue;
    const std::string rate =
        s.longer_m.mean > s.longer_m.half ? fmt::format("{:.0f}", s.gained_m.mean / s.longer_m.mean) : "–";
    out +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", s.world, s.method, s.lambda, plus_minus(s.gained_m),
                    plus_minus(s.gained_near_m), plus_minus(s.longer_m), plus_minus(s.later_s, 3), rate);
  }
  return out;
}

}  // namespace tern
