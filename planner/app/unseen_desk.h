// The desk for unseen movers: sends a PLAN_UNSEEN after each PLAN.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "core/world/horizon.h"
#include "planner/unseen/unseen_watch.h"
#include "runtime/bus.h"

namespace tern {

/// Says with each plan how long it is clear of unseen movers (first_contact), and how long the committed trajectory of
/// its request is. Both are judged by what was known when the request arrived. A trajectory that ends by t_s is clear:
/// a contact with a vehicle at rest is the mover's. Thread-safe.
class UnseenDesk {
 public:
  explicit UnseenDesk(Bus& bus) : bus_(bus) {}

  /// A request has arrived.
  void begin(const HorizonRequest& request, std::shared_ptr<const UnseenKnowledge> known);
  /// A plan was published. Its times are published if its request arrived last.
  void answered(const Plan& plan);

 private:
  [[nodiscard]] Duration clear_of(const TimedSpline& trajectory) const;

  Bus& bus_;
  std::mutex mutex_;
  std::optional<HorizonRequest> request_;
  std::shared_ptr<const UnseenKnowledge> known_;
};

}  // namespace tern
