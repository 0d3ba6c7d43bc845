// Two campaigns over the same seeds: what differs, by how much, and whether that is more than chance.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/records/flight_table.h"
#include "campaign/statistics/paired.h"

namespace tern {

struct ComparedMeasure {
  std::string name, meaning;
  PairedDifference difference;
};

struct CampaignComparison {
  CampaignIdentity a, b;
  std::int64_t pairs = 0;                         ///< seeds that both flew
  std::int64_t only_in_a = 0, only_in_b = 0;      ///< seeds that one alone flew: not compared
  std::int64_t successes_a = 0, successes_b = 0;  ///< of the pairs
  std::vector<std::uint64_t> a_alone, b_alone;    ///< seeds at which one alone succeeded
  double p_value = 1.0;                           ///< McNemar's, of a_alone against b_alone
  std::int64_t different_a = 0, different_b = 0;  ///< flights of the pairs that differ from each other
  std::vector<ComparedMeasure> measures;          ///< over the pairs that have it (Compared), at least one pair
  bool same_flights = false;  ///< of one configuration and version, and no pair differs in any measure
  /// Pairs that are independent of each other; if not, no interval and no probability means anything.
  [[nodiscard]] bool may_infer() const { return !same_flights && different_a == pairs && different_b == pairs; }
};

/// How many of the flights differ from each other (DistinctFlights). O(n log n).
std::int64_t different_flights(const std::map<std::uint64_t, FlightRecord>& records);

/// Every measure of the columns (column_notes) and the metres inside each region. @return an Error without common
/// seeds, or of two scenarios: their worlds have nothing in common but the seed's number.
Result<CampaignComparison> compare(const Flights& a, const Flights& b);

/// "A: paper_corridor 100, charge counts, configuration …, version …".
std::string in_words(const char* which, const CampaignIdentity& id);

enum class TableForm { Text, Markdown, Latex };

/// Measures in which no pair differs are named, not listed. Intervals are left out, with a word on why, unless
/// may_infer(), and of measures that have too few pairs.
std::string to_text(const CampaignComparison& comparison, TableForm form);

}  // namespace tern
