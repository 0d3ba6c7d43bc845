// The events of a flight: the marks on the page's timeline.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/wire/health.h"
#include "core/world/flight_result.h"
#include "core/world/goal.h"
#include "core/world/horizon.h"
#include "core/world/vehicle.h"

namespace tern {

/// A mark on the timeline.
struct FlightEvent {
  UTime at;
  const char* kind;  ///< "goal", "outcome", "evasion", "clearance", "stop", "late", "restart" or "result"
  std::string text;  ///< in words
};

/// Collects events from messages in the order of arrival. Pure.
class FlightEvents {
 public:
  void receive(const UavState& message);
  void receive(const Plan& message);
  /// @param taken_ms, allowed_ms  on the flight's clock, from the request to its answer and to its deadline; 0: unknown
  void receive(const PlanTiming& message, double taken_ms, double allowed_ms);
  void receive(const Goal& message);
  void receive(const FlightResult& message);
  void receive(const Heartbeat& message);
  /// @param obstacles_m, map_m  from the body to the nearest obstacle and to the nearest occupied voxel
  void receive_clearance(UTime at, std::optional<double> obstacles_m, std::optional<double> map_m);

  /// Returns all events by time. Of clearances, the five nearest passes of obstacles and of the map are included.
  [[nodiscard]] std::vector<FlightEvent> events() const;
  /// Returns {"left_out": n, "events": [{"t": s from `zero`, "kind", "text"}]}.
  [[nodiscard]] std::string json(UTime zero) const;

 private:
  /// Finds passes: local minima after which the clearance rises by more than 0.1 m.
  class Passes {
   public:
    void receive(UTime at, double metres);
    void write(const char* what, std::vector<FlightEvent>& events) const;

   private:
    struct Pass {
      UTime at;
      double metres;
    };
    std::vector<Pass> nearest_;
    std::optional<Pass> low_;  ///< least clearance since the last pass, until it rises
    double high_ = 0.0;        ///< greatest clearance since the last pass
  };
  void add(UTime at, const char* kind, std::string text);

  std::vector<FlightEvent> events_;
  std::int64_t left_out_ = 0;
  Passes obstacles_, map_;
  std::optional<PlanOutcome> outcome_;
  std::int64_t goal_id_ = 0;
  bool flies_ = false, has_result_ = false;
  std::map<std::string, std::int64_t> epochs_;  ///< sender epochs of processes, by name
};

}  // namespace tern
