// Compares two campaigns over the same seeds: differences, their size, and their significance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_table.h"
#include "campaign/statistics/paired.h"

namespace tern {

/// A measure of flights (for example flight_time_s), and its difference between the campaigns.
struct ComparedMeasure {
  std::string name, meaning;
  PairedDifference difference;
};

/// The comparison of campaigns A and B.
struct CampaignComparison {
  CampaignIdentity a, b;
  std::int64_t pairs = 0;                         ///< seeds that both flew
  std::int64_t only_in_a = 0, only_in_b = 0;      ///< seeds that only one flew; not compared
  std::int64_t successes_a = 0, successes_b = 0;  ///< among the pairs
  std::vector<std::uint64_t> a_alone, b_alone;    ///< seeds at which only one succeeded
  double p_value = 1.0;                           ///< of McNemar's test, a_alone against b_alone
  std::int64_t different_a = 0, different_b = 0;  ///< distinct flights of A, of B, among the pairs (different_flights)
  std::vector<ComparedMeasure> measures;  ///< each over the pairs in which both flights have a value; ≥ 1 pair
  bool same_flights = false;              ///< same configuration and version, and no pair differs in any measure

  /// Returns true if the pairs are independent, so that intervals and p-values are valid. The flights of each campaign
  /// are then all distinct, and A and B differ.
  [[nodiscard]] bool may_infer() const { return !same_flights && different_a == pairs && different_b == pairs; }
};

/// Returns the number of distinct flights; equal flights count once (DistinctFlights). O(n log n).
std::int64_t different_flights(const std::map<std::uint64_t, FlightRecord>& records);

/// Compares every measure of the columns (column_notes) and the metres inside each region.
/// @return an Error if no seed is common, or if the scenarios differ: equal seeds then mean different worlds
Result<CampaignComparison> compare(const Flights& a, const Flights& b);

/// Returns "A: paper_corridor 100, charge counts, configuration …, version …".
std::string in_words(const char* which, const CampaignIdentity& id);

enum class TableForm { Text, Markdown, Latex };

/// Lists the measures that differ, and names the others. Intervals are given if may_infer() and there are enough pairs;
/// otherwise the text says why they are left out.
std::string to_text(const CampaignComparison& comparison, TableForm form);

}  // namespace tern
