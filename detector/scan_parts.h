// Joins the messages of one measurement: an image or a scan may be sent in parts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/time.h"
#include "core/world/scan.h"

namespace tern {

/// Collects the messages of each sensor. Messages with the same time are one measurement.
///
/// | event                                          | effect                                               |
/// |------------------------------------------------|------------------------------------------------------|
/// | a message of another time                      | the measurement that waits is complete               |
/// | kPatience without a message                    | the same                                             |
/// | an image has as many rows as the one before it | the same                                             |
/// | a newer one is complete before it was taken    | left out: only the newest one of a sensor is used    |
/// | the measurement would exceed kMaxValues        | the message is refused                               |
/// | a message of more than kMaxSensors sensors     | the same                                             |
/// | kForgotten without a message of a sensor       | its place is free for another one                    |
///
/// @tparam M  DepthImage or CloudScan
template <class M>
class ScanParts {
 public:
  /// A measurement is complete this long after its last message.
  static constexpr Duration kPatience{50'000};
  static constexpr std::size_t kMaxSensors = 16;
  /// A sensor does not count this long after its last message.
  static constexpr Duration kForgotten{5'000'000};
  static constexpr std::size_t kMaxValues = 2'097'152;  ///< depths or points

  /// A whole measurement.
  struct Whole {
    std::vector<M> parts;
    std::size_t values = 0;  ///< in all parts
    int rows = 0;            ///< DepthImage: the number of rows that were sent
  };

  /// @return false if the message is refused
  bool add(const M& part, UTime received) {
    if (!has_place(part.sensor_id, received)) return false;
    Sensor& sensor = sensors_[part.sensor_id];
    if (!sensor.waiting.parts.empty() && sensor.waiting.parts.front().at != part.at) finish(sensor);
    if (sensor.waiting.values + values_of(part) > kMaxValues) return false;
    sensor.waiting.values += values_of(part);
    sensor.waiting.parts.push_back(part);
    sensor.waiting.rows = std::max(sensor.waiting.rows, last_row(part));
    sensor.received = received;
    if (sensor.rows > 0 && rows_of(sensor.waiting) >= sensor.rows) finish(sensor);
    return true;
  }
  /// Returns the newest whole measurement of each sensor, in the order of their ids.
  std::vector<Whole> take(UTime now) {
    std::vector<Whole> whole;
    for (auto& [id, sensor] : sensors_) {
      if (!sensor.waiting.parts.empty() && now - sensor.received >= kPatience) finish(sensor);
      if (!sensor.ready.parts.empty()) whole.push_back(std::exchange(sensor.ready, {}));
    }
    return whole;
  }
  /// When a measurement is complete even without another message; nullopt if none waits.
  [[nodiscard]] std::optional<UTime> next_complete() const {
    std::optional<UTime> next;
    for (const auto& [id, sensor] : sensors_) {
      if (sensor.waiting.parts.empty()) continue;
      const UTime complete = sensor.received + kPatience;
      next = std::min(next.value_or(complete), complete);
    }
    return next;
  }
  [[nodiscard]] bool any_ready() const {
    return std::ranges::any_of(sensors_, [](const auto& entry) { return !entry.second.ready.parts.empty(); });
  }
  /// The number of measurements that were left out.
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }

 private:
  struct Sensor {
    Whole waiting, ready;
    UTime received;
    int rows = 0;  ///< of the last whole image
  };
  bool has_place(std::int32_t id, UTime now) {
    if (sensors_.contains(id) || sensors_.size() < kMaxSensors) return true;
    std::erase_if(sensors_, [&](const auto& entry) { return now - entry.second.received > kForgotten; });
    return sensors_.size() < kMaxSensors;
  }
  static std::size_t values_of(const DepthImage& part) { return part.depths.size(); }
  static std::size_t values_of(const CloudScan& part) { return part.points.size(); }
  static int last_row(const DepthImage& part) {
    return part.first_row + static_cast<int>(part.depths.size()) / std::max(part.width, 1);
  }
  static int last_row(const CloudScan& /*part*/) { return 0; }
  /// The number of rows that have come; parts may overtake each other.
  static int rows_of(const Whole& whole) {
    int rows = 0;
    for (const M& part : whole.parts) rows += last_row(part) - first_row(part);
    return rows;
  }
  static int first_row(const DepthImage& part) { return part.first_row; }
  static int first_row(const CloudScan& /*part*/) { return 0; }
  void finish(Sensor& sensor) {
    if (!sensor.ready.parts.empty()) ++left_out_;
    sensor.rows = sensor.waiting.rows;
    sensor.ready = std::exchange(sensor.waiting, {});
  }

  std::map<std::int32_t, Sensor> sensors_;
  std::int64_t left_out_ = 0;
};

}  // namespace tern
