// What tern-campaign says of a flight: a line of CSV; with --trace a line per answer.
#pragma once

#include <cstdint>
#include <string>

#include "campaign/virtual_flight.h"

namespace tern {

/// The names of flight_line's columns.
const char* flight_columns();
/// Times are thread CPU or wall milliseconds of this machine; the others are the same wherever the flight is flown.
std::string flight_line(std::int64_t seed, const VirtualFlight& flight);

/// Says every answer on stderr: where the vehicle was, what it got, how far the plan goes.
class PlanTracer final : public FlightObserver {
 public:
  void on_request(const HorizonRequest& request) override { request_ = request; }
  void on_plan(const Plan& plan) override;

 private:
  HorizonRequest request_;
};

}  // namespace tern
