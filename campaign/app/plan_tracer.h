// Says every answer of a flight on stderr: where the vehicle was, what it got, how far the plan goes.
#pragma once

#include "campaign/recorded_flight.h"

namespace tern {

class PlanTracer final : public FlightObserver {
 public:
  void on_request(const HorizonRequest& request) override { request_ = request; }
  void on_plan(const Plan& plan) override;

 private:
  HorizonRequest request_;
};

}  // namespace tern
