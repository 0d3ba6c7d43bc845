// tern-planner's node: requests in, certified plans out, in time whatever happens.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/world/scenario.h"
#include "core/world/search_view.h"
#include "planner/app/answer_desk.h"
#include "planner/app/worker.h"
#include "planner/app/world_intake.h"
#include "planner/plan_workspace.h"
#include "planner/planner.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// A worker is not taken for stuck before this, however near the deadline its request came. A busy machine may keep it
/// waiting, and a restart loses the map.
inline constexpr Duration kStuckAfter{500'000};

/// How a node spends time.
struct PlannerExecution {
  /// Plan in a thread of its own, under the wall clock and the watchdog; else at once, in virtual time.
  bool threaded = true;
  Duration virtual_latency{15'000};  ///< virtual time from request to answer: the budget is unlimited then …
  /// … unless a plan takes the CPU time of its thread instead, under the budget and the watchdog of a live one.
  bool charge_cpu = false;
};

class PlannerNode final : public Node {
 public:
  /// @param places  what may be called by its name where no way leads to a goal
  PlannerNode(Bus& bus, const UavSpec& uav, const PlannerConfig& config, std::uint64_t configuration_hash,
              const PlannerExecution& execution, std::vector<NamedPlace> places = {});
  ~PlannerNode() override;

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  /// kExitStuck when a worker is stuck (it has missed two deadlines, and been at it for kStuckAfter at least) or has
  /// thrown.
  [[nodiscard]] std::optional<int> finished() const override { return exit_code_; }

 private:
  void on_request(const HorizonRequest& request);
  void start_planning(UTime now);
  void work(const HorizonRequest& request, const PlanningWorld& world, UTime arrived);
  void publish_search(std::int64_t request_id, std::vector<SearchViewNode> nodes);
  void work_in_virtual_time(const HorizonRequest& request, const PlanningWorld& world, UTime arrived);
  void deliver_delayed(UTime now);
  void watch(UTime now);
  void look_after_workers(UTime now);
  [[nodiscard]] bool has_watchdog() const { return execution_.threaded || execution_.charge_cpu; }

  Bus& bus_;
  PlannerConfig config_;
  PlannerExecution execution_;
  WorldIntake intake_;
  AnswerDesk desk_;
  Header last_request_;                    ///< the newest: a network may deliver a message late
  std::optional<HorizonRequest> waiting_;  ///< came in while the worker was busy
  UTime waiting_since_{};
  std::optional<UTime> stuck_at_;  ///< when what the worker is at has taken too long
  UTime next_look_{};              ///< at the workers
  std::optional<int> exit_code_;
  struct Delayed {
    std::vector<std::pair<UTime, Plan>> improvements;  ///< what stood on the way, and from when on
    std::size_t next = 0;                              ///< the first of them that the desk has not seen
    UTime due;
    Plan plan;
    PlanTiming timing;
  };
  PlanWorkspace workspace_;         ///< of whichever thread plans: one request at a time
  std::optional<Delayed> delayed_;  ///< virtual time: the answer of a worker that is still at it
  std::unique_ptr<Worker> worker_;  ///< null in virtual time. Last: its job uses the others
};

}  // namespace tern
