// FLIGHTS.csv as a table that one process extends while flights end; it survives a crash of that process at any time.
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
  std::map<std::uint64_t, FlightTimes> times;  ///< may lack some of the flights
};

/// Returns the name of the file with the answer times: "FLIGHTS.csv.times".
std::string times_file(const std::string& flights_file);

/// Reads both files; the file of times may be missing. Text without a line end is ignored, and so are times of flights
/// that are not in FLIGHTS.csv.
/// @return an Error that names file, line and column; also if flights differ in identity
Result<Flights> read_flights(const std::string& file);

/// Writes both files, sorted by seed. New files are written first and then renamed, so a complete file always exists.
Result<void> write_flights(const std::string& file, const Flights& flights);

/// Adds the flights of another file of the same campaign. @return an Error if identities differ, or if both contain a
/// seed with different results; `all` then has the flights before that seed
Result<void> join(Flights& all, Flights more);

/// Appends to both files. When add() returns, the flight's line was written in one piece and has reached the disk.
class FlightTable {
 public:
  /// Opens or creates a table and locks it.
  /// @return an Error if another process has locked it, if it cannot be read or written, or if its identity differs
  static Result<FlightTable> open(const std::string& file, const CampaignIdentity& identity);
  FlightTable(FlightTable&& other) noexcept = default;
  FlightTable& operator=(FlightTable&&) = delete;
  FlightTable(const FlightTable&) = delete;
  FlightTable& operator=(const FlightTable&) = delete;
  ~FlightTable();

  [[nodiscard]] const Flights& flights() const { return flights_; }
  [[nodiscard]] bool has(std::uint64_t seed) const { return flights_.records.contains(seed); }
  /// Adds a flight. @pre !has(record.seed), and times are of the same seed
  Result<void> add(const FlightRecord& record, const FlightTimes& times);
  /// Sorts the lines by seed. It may be the last call: nothing can be added later.
  Result<void> close_sorted();

 private:
  explicit FlightTable(std::string file) : file_(std::move(file)) {}
  Result<void> begin(const std::string& path, Descriptor& table, const CsvRecord& columns,
                     std::size_t whole_bytes) const;

  std::string file_;
  Flights flights_;
  Descriptor lock_, times_file_, flights_file_;  ///< the lock is released last
};

}  // namespace tern
