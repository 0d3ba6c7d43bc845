// The answer desk: exactly one answer per request and in time, from the worker or else from the watchdog.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "core/world/horizon.h"
#include "runtime/bus.h"

namespace tern {

/// The watchdog sends the incumbent this long before the deadline, since an answer must still travel and be checked.
inline constexpr Duration kWatchdogLead{4'000};

/// Returns the first incumbent of a request: NoPlan, out of time. It depends on the request alone.
Plan unanswered(const HorizonRequest& request);

/// Shared by the receiving thread, which opens requests and runs the watchdog, and the worker, which gives answers.
/// Thread-safe.
///
/// | event                                    | effect                                             |
/// |------------------------------------------|----------------------------------------------------|
/// | open() while another request is open     | that request's incumbent is sent first             |
/// | improve() for the open request           | the plan becomes the incumbent                     |
/// | answer() for the open request            | the plan is sent, and the request is closed        |
/// | watch() kWatchdogLead before the deadline | the incumbent is sent, and the request is closed   |
/// | improve() or answer() for another request | ignored                                            |
class AnswerDesk {
 public:
  explicit AnswerDesk(Bus& bus, std::uint64_t configuration_hash)
      : bus_(bus), configuration_hash_(configuration_hash) {}

  /// Calls `sent` with each plan right after it was published.
  void on_sent(std::function<void(const Plan&)> sent) { sent_ = std::move(sent); }
  /// Opens a request that arrived at `now`.
  void open(const HorizonRequest& request, UTime now);
  /// Takes an incumbent from the worker.
  void improve(const Plan& plan);
  /// Takes the worker's answer. @return false if the watchdog has answered already
  bool answer(const Plan& plan, const PlanTiming& timing);
  /// Runs the watchdog.
  void watch(UTime now);
  /// Returns when watch() must be called, or nullopt if no request is open.
  [[nodiscard]] std::optional<UTime> watch_time() const;

 private:
  struct Open {
    std::int64_t id = 0;
    UTime arrived;
    UTime watch_at;
    Plan incumbent;  ///< unanswered() until the worker has a candidate
    std::int32_t improvements = 0;
  };
  void send_incumbent(UTime now);
  void send(Plan plan, const PlanTiming& timing);

  Bus& bus_;
  std::uint64_t configuration_hash_;
  std::function<void(const Plan&)> sent_;
  mutable std::mutex mutex_;
  std::optional<Open> open_;
};

}  // namespace tern
