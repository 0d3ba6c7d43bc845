// Exactly one answer per request, in time: from the worker when it is done, else from the watchdog.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

#include "core/world/horizon.h"
#include "runtime/bus.h"

namespace tern {

/// The watchdog sends what stands this long before the deadline: an answer must still travel and be checked.
inline constexpr Duration kWatchdogLead{4'000};

/// The answer while the worker has none: NoPlan, out of time; it rests on the request alone.
Plan unanswered(const HorizonRequest& request);

/// Shared by the receiving thread (opens requests, runs the watchdog) and the worker (improves and gives answers).
/// Thread-safe.
class AnswerDesk {
 public:
  explicit AnswerDesk(Bus& bus, std::uint64_t configuration_hash)
      : bus_(bus), configuration_hash_(configuration_hash) {}

  /// A request came in at `now`. An older one that is still open is answered first with what stands.
  void open(const HorizonRequest& request, UTime now);
  /// The worker has a better answer for this request; kept for the watchdog.
  void improve(const Plan& plan);
  /// The worker is done. @return false when the watchdog had answered already.
  bool answer(const Plan& plan, const PlanTiming& timing);
  /// Sends what stands when the watchdog's time has come.
  void watch(UTime now);
  /// @return when watch() wants to be called, or nullopt if no request is open.
  [[nodiscard]] std::optional<UTime> watch_time() const;

 private:
  struct Open {
    std::int64_t id = 0;
    UTime arrived;
    UTime watch_at;
    Plan incumbent;  ///< unanswered(), until the worker has more
    std::int32_t improvements = 0;
  };
  void send_incumbent(UTime now);
  void send(Plan plan, const PlanTiming& timing);

  Bus& bus_;
  std::uint64_t configuration_hash_;
  mutable std::mutex mutex_;
  std::optional<Open> open_;
};

}  // namespace tern
