// FLIGHTS.csv as a book that is written on while flights end, by one process, and survives its death at any moment.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "campaign/records/flight_record.h"
#include "core/base/files.h"
#include "core/base/result.h"

namespace tern {

/// The flights of a campaign, by seed.
struct Flights {
  std::map<std::uint64_t, FlightRecord> records;
  std::map<std::uint64_t, FlightTimes> times;  ///< of some of them, at least
};

/// FLIGHTS.csv's companion with the answers' times: "FLIGHTS.csv.times".
std::string times_file(const std::string& flights_file);

/// Reads both files; the companion may be missing. A rest without a line end is left out, and so are times of flights
/// that are not in the book.
/// @return an Error that names file, line and column; also when flights differ in identity.
Result<Flights> read_flights(const std::string& file);

/// Writes both files anew, by seed: first beside them, then in their place, so that there is always a whole one.
Result<void> write_flights(const std::string& file, const Flights& flights);

/// Adds the flights of another file of the same campaign. @return an Error when identities differ, or a seed is in both
/// with other results; `all` is then as it was but for what came before.
Result<void> join(Flights& all, Flights more);

/// Appends to both files. A flight is in the book once add() has returned: its line was written in one piece and has
/// reached the disk.
class FlightTable {
 public:
  /// Opens or begins a book and holds it alone until the end.
  /// @return an Error when another process holds it, when it cannot be read or written, or when its flights are of
  /// another identity.
  static Result<FlightTable> open(const std::string& file, const CampaignIdentity& identity);
  FlightTable(FlightTable&& other) noexcept = default;
  FlightTable& operator=(FlightTable&&) = delete;
  FlightTable(const FlightTable&) = delete;
  FlightTable& operator=(const FlightTable&) = delete;
  ~FlightTable();

  [[nodiscard]] const Flights& flights() const { return flights_; }
  [[nodiscard]] bool has(std::uint64_t seed) const { return flights_.records.contains(seed); }
  /// @pre !has(record.seed), and times are of the same seed
  Result<void> add(const FlightRecord& record, const FlightTimes& times);
  /// Puts the lines in the order of the seeds. The book may be closed then, not added to.
  Result<void> close_sorted();

 private:
  explicit FlightTable(std::string file) : file_(std::move(file)) {}
  Result<void> begin(const std::string& path, Descriptor& table, const CsvRecord& columns,
                     std::size_t whole_bytes) const;

  std::string file_;
  Flights flights_;
  Descriptor lock_, times_file_, flights_file_;  // the lock ends last
};

}  // namespace tern
