// Prints every answer of a flight on stderr: the vehicle's place, the outcome, the plan's reach.
#pragma once

#include "campaign/recorded_flight.h"

namespace tern {

/// Traces the answers of one flight.
class PlanTracer final : public FlightObserver {
 public:
  void on_request(const HorizonRequest& request) override { request_ = request; }
  void on_plan(const Plan& plan) override;

 private:
  HorizonRequest request_;
};

}  // namespace tern
