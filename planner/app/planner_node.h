// The node of tern-planner: one plan per request, always in time.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/scenario/scenario.h"
#include "core/world/search_view.h"
#include "planner/app/answer_desk.h"
#include "planner/app/heading_desk.h"
#include "planner/app/unseen_desk.h"
#include "planner/app/unseen_intake.h"
#include "planner/app/worker.h"
#include "planner/app/world_intake.h"
#include "planner/plan_workspace.h"
#include "planner/planner.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// A worker is not considered stuck before this time, even if its request had a short deadline. A busy machine may keep
/// it waiting, and a restart loses the map.
inline constexpr Duration kStuckAfter{500'000};

/// How a node spends time on a plan.
struct PlannerExecution {
  /// true: plan in a worker thread, under the wall clock and the watchdog. false: plan at once, in virtual time.
  bool threaded = true;
  Duration virtual_latency{15'000};  ///< virtual time from request to answer; the budget is unlimited.
  /// In virtual time: an answer takes the CPU time of its thread instead, under the budget and watchdog of live flight.
  bool charge_cpu = false;
};

class PlannerNode final : public Node {
 public:
  /// @param places  obstacles and regions that messages about a blocked goal call by name
  PlannerNode(Bus& bus, const UavSpec& uav, const PlannerConfig& config, std::uint64_t configuration_hash,
              const PlannerExecution& execution, std::vector<NamedPlace> places = {});
  ~PlannerNode() override;

  [[nodiscard]] UTime next_wakeup() const override;
  void step(UTime now) override;
  [[nodiscard]] NodeHealth health() const override;
  /// Returns kExitStuck if a worker has thrown, or is stuck: it has missed two deadlines and been busy for kStuckAfter.
  [[nodiscard]] std::optional<int> finished() const override { return exit_code_; }
  /// Whether a worker thread is planning; always false in virtual time.
  [[nodiscard]] bool busy() const { return worker_ && worker_->busy(); }

 private:
  void on_request(const HorizonRequest& request);
  void on_sent(const Plan& plan);
  [[nodiscard]] PlanningWorld world_now() const;
  void start_planning(UTime now);
  void work(const HorizonRequest& request, const PlanningWorld& world, UTime arrived);
  void publish_search(std::int64_t request_id, std::vector<SearchViewNode> nodes);
  void work_in_virtual_time(const HorizonRequest& request, const PlanningWorld& world, UTime arrived);
  void deliver_delayed(UTime now);
  void watch(UTime now);
  void check_workers(UTime now);
  [[nodiscard]] bool has_watchdog() const { return execution_.threaded || execution_.charge_cpu; }

  Bus& bus_;
  PlannerConfig config_;
  PlannerExecution execution_;
  WorldIntake intake_;
  HeadingDesk headings_;
  UnseenDesk unseen_desk_;
  std::optional<UnseenIntake> unseen_;  ///< with `planner.unseen: passive`
  AnswerDesk desk_;
  Header last_request_;                    ///< header of the newest request: the network may deliver messages late
  std::optional<HorizonRequest> waiting_;  ///< the newest request that arrived while the worker was busy
  UTime waiting_since_{};
  std::optional<UTime> stuck_at_;  ///< from then on the worker's job has taken too long
  UTime next_check_{};             ///< time of the next check of the workers
  std::optional<int> exit_code_;
  struct Delayed {
    std::vector<std::pair<UTime, Plan>> improvements;  ///< incumbents with their times
    std::size_t next = 0;                              ///< index of the first that the desk has not received
    UTime due;
    Plan plan;
    PlanTiming timing;
  };
  PlanWorkspace workspace_;         ///< used by one thread at a time
  std::optional<Delayed> delayed_;  ///< in virtual time: the answer that is not due yet
  std::unique_ptr<Worker> worker_;  ///< null in virtual time. Last member: its job uses the others
};

}  // namespace tern
