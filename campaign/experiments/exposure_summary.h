// Benefit and cost of semantics: compares flights with semantics to flights of the same seeds without semantics.
#pragma once

#include <string>
#include <vector>

#include "campaign/experiments/mean_interval.h"
#include "campaign/experiments/semantic_flights.h"

namespace tern {

/// All flights of one world, method and λ. Means are over the flights that reached the goal.
struct ExposureSummary {
  std::string world, method;
  double lambda = 0.0;
  int flights = 0, reached = 0;
  /// Path inside the region (inside_) and inside or within 1 m of it (near_), and the whole flight; metres and seconds.
  MeanInterval inside_m, inside_s, near_m, near_s, path_length_m, flight_time_s;
  /// Differences to the flight of the same seed without semantics, if both reached the goal. Gained: additional metres
  /// inside an attracting region, or fewer metres inside a repelling one. Longer, later: additional path and time.
  MeanInterval gained_m, gained_near_m, longer_m, later_s;
};

/// One summary per (world, method, λ), in the order of semantic_worlds, semantic_methods and λ.
std::vector<ExposureSummary> summarize_exposure(const std::vector<SemanticFlight>& flights);

/// With a header line.
std::string to_csv(const std::vector<ExposureSummary>& summaries);
/// Two Markdown tables: means of the flights, and differences to flights without semantics.
std::string to_markdown(const std::vector<ExposureSummary>& summaries);

}  // namespace tern
