// The share of the flight in which the planner certified the committed trajectory against unseen movers.
#pragma once

#include <deque>
#include <optional>

#include "core/world/horizon.h"
#include "core/world/plan_unseen.h"

namespace tern {

/// Sums time by PLAN_UNSEEN, as tern-audit does by a field of its own (check *unseen*). From t_s of one request to t_s
/// of the next one, the committed trajectory of the former counts. That time is certified if this trajectory is
/// passively safe; without a PLAN_UNSEEN for the request it is not.
class CertifiedShare {
 public:
  /// @param request  each once, in their order
  void add(const HorizonRequest& request);
  /// A message about a request that is not among the last kOpen ones is ignored.
  void add(const PlanUnseen& unseen);
  /// Returns the share until the vehicle's time `end`, [0, 1]; nullopt before the first PLAN_UNSEEN, or for a time of
  /// 0.
  [[nodiscard]] std::optional<double> until(UTime end) const;

 private:
  /// So many requests wait for their PLAN_UNSEEN, since messages of different processes may overtake each other.
  static constexpr std::size_t kOpen = 8;

  struct Times {
    double all_s = 0.0, certified_s = 0.0;
    void add(double seconds, bool certified) {
      all_s += seconds;
      if (certified) certified_s += seconds;
    }
  };
  struct Request {
    MessageName name;
    UTime start;  ///< t_s
    bool certified = false;
  };
  std::deque<Request> open_;
  Times times_;  ///< up to the first of open_
  bool reported_ = false;
};

}  // namespace tern
