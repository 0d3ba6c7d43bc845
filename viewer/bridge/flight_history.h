// The past of a flight, in bounded memory: path, every number of the messages, outcomes of the answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/types.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/number_writer.h"

namespace tern {

/// Stores samples by the vehicle's clock; samples out of order are ignored. A table holds 432,000 rows, six hours of
/// answers or nearly five hours of states. When it is full, its older half is deleted.
class FlightHistory {
 public:
  /// Adds a state; at most one per 50 ms is stored.
  void add(const UavState& state);
  /// Returns true if add_row() would store a row at this time: at most one per 40 ms. Ask before computing the fields.
  [[nodiscard]] bool keeps_row(const std::string& table, UTime at) const;
  /// Adds a row. @param fields  of one message; the first row fixes the columns of its table
  /// @return true if it is the first row
  bool add_row(const std::string& table, UTime at, const NumberFields& fields);
  void add_answer(UTime at, PlanOutcome outcome);

  /// Returns the names of all fields received so far, sorted.
  [[nodiscard]] std::vector<std::string> fields() const;
  [[nodiscard]] UTime begin() const { return motion_.empty() ? UTime{} : motion_.front().at; }
  /// Returns when the vehicle first exceeded 0.05 m/s; nullopt if it did not.
  [[nodiscard]] std::optional<UTime> departure() const;

  /// Returns {"zero_us", "begin_s", "end_s", "series": {name: [[t…], [value…]]}, "outcomes": [[t…], [outcome…]]}, with
  /// t in seconds from `zero`, from the begin to `until`. A series has at most 2·`most` points: the least and the
  /// greatest of each stretch, so no extreme is lost.
  [[nodiscard]] std::string chart_json(UTime zero, UTime until, const std::vector<std::string>& names,
                                       std::size_t most = 600) const;
  /// Writes members "t": [s from `zero`…] and "curve": [x, y, z, speed, …] up to `until`, with at most `most` points.
  void write_path(JsonWriter& json, UTime zero, UTime until, std::size_t most = 3'000) const;

 private:
  struct Motion {
    UTime at;
    Vec3 p;
    double speed;
  };
  struct Table {
    std::vector<std::string> names;
    std::vector<UTime> at;
    std::vector<float> values;  ///< row by row
  };
  struct Answer {
    UTime at;
    int outcome;
  };
  void write_series(JsonWriter& json, UTime zero, UTime until, const std::string& name, std::size_t most) const;

  std::vector<Motion> motion_;
  std::map<std::string, Table> tables_;
  std::vector<Answer> answers_;
};

}  // namespace tern
