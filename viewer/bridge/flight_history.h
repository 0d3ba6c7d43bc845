// A flight's past, in bounded memory: the path, every number that messages carry, the answers' outcomes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/types.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"
#include "viewer/bridge/json_writer.h"

namespace tern {

/// {"PLAN_TIMING.total_ms", 12.5}, …: the numbers of one message, by channel and field.
using NumberFields = std::vector<std::pair<std::string, double>>;

/// The numbers in what detail_json() tells: numbers and booleans; a list of three is its x, y and z. Names, times in
/// µs since the epoch and longer lists are left out.
NumberFields numbers_of(std::string_view detail_json);

/// Times are the vehicle's clock; what comes out of order is left out. A row that is full (432,000: six hours of
/// answers, nearly five of states) forgets its older half.
class FlightHistory {
 public:
  /// At most one per 50 ms is kept.
  void add(const UavState& state);
  /// Whether a row of this name would be kept now: at most one per 40 ms is. Who asks before saves the work.
  [[nodiscard]] bool keeps_row(const std::string& table, UTime at) const;
  /// @param fields  of one message; its first row says which fields a table has
  /// @return whether it is the first
  bool add_row(const std::string& table, UTime at, const NumberFields& fields);
  void add_answer(UTime at, PlanOutcome outcome);

  /// The names of all fields that were ever heard, sorted.
  [[nodiscard]] std::vector<std::string> fields() const;
  [[nodiscard]] UTime begin() const { return motion_.empty() ? UTime{} : motion_.front().at; }
  /// When it flew first (faster than 0.05 m/s); nullopt before.
  [[nodiscard]] std::optional<UTime> departure() const;

  /// {"zero_us", "begin_s", "end_s", "series": {name: [[t…], [value…]]}, "outcomes": [[t…], [outcome…]]}, t in seconds
  /// from `zero`, all of the flight until `until`. A series has at most 2·`most` points: of every stretch the least and
  /// the greatest, so that no extreme is lost.
  [[nodiscard]] std::string chart_json(UTime zero, UTime until, const std::vector<std::string>& names,
                                       std::size_t most = 600) const;
  /// Members "t": [s from `zero`…], "curve": [x, y, z, speed, …] from the start to `until`, at most `most` points.
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
    std::vector<float> values;  ///< a row after the other
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
