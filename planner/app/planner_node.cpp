#include "planner/app/planner_node.h"

#include <algorithm>
#include <tuple>

#include "core/geometry/separation.h"
#include "messages/channels.h"
#include "messages/codec.h"
#include "planner/app/plan_stopwatch.h"
#include "planner/problem/tuning.h"
#include "runtime/log.h"
#include "runtime/process.h"

namespace tern {
namespace {

/// Workers are checked this often, with or without messages.
constexpr Duration kCheckPeriod{20'000};

/// Returns a budget that ends each stage by the clock, so that the worker is done before the watchdog acts.
Budget clock_budget(const Clock& clock, UTime arrived, UTime watch_at) {
  const auto at = [&](double share) {
    return arrived + Duration{static_cast<std::int64_t>(share * static_cast<double>((watch_at - arrived).us))};
  };
  return Budget([&clock, attempts = at(kAttemptShare), search = at(kSearchShare),
                 optimization = at(kOptimizationShare)](const BudgetCut& here) {
    const UTime now = clock.now();
    if (here.phase != Phase::Durations || here.stage == Stage::Optimization) return now >= optimization;
    if (here.stage == Stage::Search) return now >= search;
    return now >= attempts;
  });
}

/// Compares by the time of sending, which cannot be forged far ahead. Sequence numbers only order messages of one
/// instant.
bool is_newer(const Header& request, const Header& last) {
  if (request.name.sender_epoch_us != last.name.sender_epoch_us) return true;
  return std::pair(request.utime, request.name.sequence) > std::pair(last.utime, last.name.sequence);
}

/// Calls plan() and measures it. @pre `budget` and `stopwatch` were made for this call
std::pair<Plan, PlanTiming> timed_plan(const HorizonRequest& request, const PlanningWorld& world,
                                       const PlannerConfig& config, Budget& budget, PlanWorkspace& workspace,
                                       PlanStopwatch& stopwatch) {
  const SeparationCounts before = separation_counts();
  PlanAnswer answer = plan(request, world, config, budget, workspace, &stopwatch);
  PlanTiming timing = stopwatch.timing(answer);
  timing.pairs_by_lp = separation_counts().lp - before.lp;
  return {std::move(answer.plan), timing};
}

}  // namespace

PlannerNode::PlannerNode(Bus& bus, const UavSpec& uav, const PlannerConfig& config, std::uint64_t configuration_hash,
                         const PlannerExecution& execution, std::vector<NamedPlace> places)
    : bus_(bus),
      config_(config),
      execution_(execution),
      intake_(bus, config, uav, execution.threaded, std::move(places)),
      headings_(bus, config, uav.heading),
      unseen_desk_(bus),
      desk_(bus, configuration_hash) {
  if (config.unseen == UnseenMode::Passive) unseen_.emplace(bus, config.unseen_movers, uav.start);
  desk_.on_sent([this](const Plan& plan) { on_sent(plan); });
  bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& r) { on_request(r); });
  if (execution.threaded) worker_ = std::make_unique<Worker>();
}

PlannerNode::~PlannerNode() = default;

UTime PlannerNode::next_wakeup() const {
  UTime next = worker_ ? next_check_ : kNever;
  if (delayed_) next = std::min(next, delayed_->due);
  if (const auto watch = desk_.watch_time(); watch && has_watchdog()) next = std::min(next, *watch);
  return next;
}

void PlannerNode::step(UTime now) {
  next_check_ = now + kCheckPeriod;
  intake_.prepare();
  if (delayed_) deliver_delayed(now);
  if (has_watchdog()) watch(now);
  if (waiting_) start_planning(now);
  if (worker_) check_workers(now);
}

/// Runs the watchdog. A request that it has answered is not planned.
void PlannerNode::watch(UTime now) {
  desk_.watch(now);
  if (waiting_ && now >= waiting_->deadline - kWatchdogLead) waiting_.reset();
}

void PlannerNode::check_workers(UTime now) {
  if (exit_code_) return;
  auto failure = worker_->failure();
  if (!failure) failure = intake_.failure();
  const bool stuck = stuck_at_ && now >= *stuck_at_ && worker_->busy();
  if (!failure && !stuck) return;
  log::critical("{}; this process exits with code {} to be restarted",
                failure ? "internal error in a worker: " + *failure : "the worker has missed two deadlines",
                kExitStuck);
  exit_code_ = kExitStuck;
}

void PlannerNode::deliver_delayed(UTime now) {
  Delayed& d = *delayed_;
  for (; d.next < d.improvements.size() && d.improvements[d.next].first <= now; ++d.next) {
    desk_.improve(d.improvements[d.next].second);
  }
  if (now < d.due) return;
  desk_.answer(d.plan, d.timing);
  delayed_.reset();
}

NodeHealth PlannerNode::health() const {
  const std::string missing = intake_.missing();
  if (!missing.empty()) return {ProcessState::Waiting, missing};
  const std::string blocked = intake_.blocked();
  return {ProcessState::Ready, blocked.empty() && unseen_ ? unseen_->missing() : blocked};
}

PlanningWorld PlannerNode::world_now() const {
  PlanningWorld world = intake_.snapshot();
  if (unseen_) world.unseen = unseen_->snapshot();
  return world;
}

void PlannerNode::on_request(const HorizonRequest& request) {
  const UTime now = bus_.clock().now();
  if (!is_newer(request.header, last_request_)) return;
  last_request_ = request.header;
  if (now >= request.deadline) return bus_.count_late(channels::kHorizonRequest);
  intake_.set_vehicle(request);
  if (unseen_) unseen_->set_vehicle(request);
  desk_.open(request, now);
  if (unseen_) unseen_desk_.begin(request, unseen_->snapshot());
  waiting_ = request;
  waiting_since_ = now;
  if (has_watchdog()) watch(now);
  if (waiting_) start_planning(now);
}

void PlannerNode::on_sent(const Plan& plan) {
  if (config_.heading == HeadingMode::Planned) headings_.answered(plan);
  if (unseen_) unseen_desk_.answered(plan);
}

void PlannerNode::start_planning(UTime now) {
  const UTime arrived = waiting_since_;
  if (!execution_.threaded) {
    if (!delayed_) work_in_virtual_time(*std::exchange(waiting_, std::nullopt), world_now(), arrived);
    return;
  }
  const Duration allowed = waiting_->deadline - arrived;
  const bool taken =
      worker_->try_start([this, request = *waiting_, world = world_now(), arrived] { work(request, world, arrived); });
  if (!taken) return;
  stuck_at_ = now + std::max(allowed * 2, kStuckAfter);
  waiting_.reset();
}

void PlannerNode::work(const HorizonRequest& request, const PlanningWorld& world, UTime arrived) {
  PlanStopwatch stopwatch([this](const Plan& plan) { desk_.improve(plan); }, &monotonic_ms);
  if (config_.publish_search) stopwatch.keep_search();
  headings_.begin(request, world);
  Budget budget = clock_budget(bus_.clock(), arrived, request.deadline - kWatchdogLead);
  auto [plan, timing] = timed_plan(request, world, config_, budget, workspace_, stopwatch);
  timing.total_ms = std::max(timing.total_ms, (bus_.clock().now() - arrived).seconds() * 1e3);
  desk_.answer(plan, timing);
  if (config_.publish_search) publish_search(request.id, stopwatch.take_nodes());
}

void PlannerNode::publish_search(std::int64_t request_id, std::vector<SearchViewNode> nodes) {
  SearchView view;
  view.request_id = request_id;
  const auto sent = std::min<std::size_t>(nodes.size(), kMaxSearchNodes);
  view.left_out = static_cast<std::int32_t>(nodes.size() - sent);
  nodes.resize(sent);
  view.nodes = std::move(nodes);
  bus_.publish(channels::kSearchView, view);
}

void PlannerNode::work_in_virtual_time(const HorizonRequest& request, const PlanningWorld& world, UTime arrived) {
  const UTime began = bus_.clock().now();
  const bool charged = execution_.charge_cpu;
  headings_.begin(request, world);
  const ThreadCpuClock cpu(began);
  Delayed delayed;
  const auto improved = [&](const Plan& p) { delayed.improvements.emplace_back(charged ? cpu.now() : began, p); };
  PlanStopwatch stopwatch(improved, &thread_cpu_ms);
  Budget budget = charged ? clock_budget(cpu, arrived, request.deadline - kWatchdogLead) : Budget::unlimited();
  std::tie(delayed.plan, delayed.timing) = timed_plan(request, world, config_, budget, workspace_, stopwatch);
  delayed.due = charged ? cpu.now() : began + execution_.virtual_latency;
  if (charged) delayed.timing.total_ms = (delayed.due - arrived).seconds() * 1e3;
  delayed_ = std::move(delayed);
}

}  // namespace tern
