#include "mission/app/mission_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/world/uploaded_fences.h"
#include "messages/batching.h"
#include "mission/check.h"
#include "runtime/log.h"

namespace tern::mission {
namespace {

constexpr Duration kGoalPeriod{1'000'000};
/// The name of an uploaded mission, in messages and records.
constexpr const char* kUploaded = "uploaded mission";
constexpr const char* kIsFlown = "a mission is being flown: let it end first";
constexpr const char* kNoMap = "tern-mission has no map yet: upload again when the mapper has sent it";

}  // namespace

MissionNode::MissionNode(Bus& bus, MissionSetup setup)
    : bus_(bus), setup_(std::move(setup)), record_(setup_.folder), listens_until_(bus.clock().now() + kListen) {
  bus_.subscribe(channels::kUavState, [this](const UavState& state) { on_state(state); });
  bus_.subscribe(channels::kVehicleStatus, [this](const VehicleStatus& status) {
    following_ = status.following;
    if (progress_) progress_->set_following(following_, bus_.received());
  });
  bus_.subscribe(channels::kGoal, [this](const Goal& goal) { on_goal(goal); });
  bus_.subscribe(channels::kSemanticMap, [this](const MapChunk& chunk) { on_map(chunk); });
  bus_.subscribe(channels::kPredictions, [this](const TrackSet& batch) { on_predictions(batch); });
  if (setup_.fence_uploads) fences_ = std::make_unique<FenceKeeper>(bus_, record_, setup_.site, setup_.uav);
  if (setup_.link) {
    MissionTaker taker{[this](const std::vector<Item>& items) { return take_upload(items); },
                       [this](Order order) { return obey(order); }, [this] { fences_->await(); },
                       [this](const std::vector<mavlink::MissionItemInt>& items) { return take_fences(items); },
                       fences_ ? "" : "fences cannot be uploaded: set mission.fence_uploads in the scenario"};
    station_ =
        std::make_unique<GroundStation>(std::move(setup_.link), setup_.system, setup_.site.frame, std::move(taker));
    if (fences_) station_->set_fences(fences_->items());
  }
  is_ordered_ = setup_.mission.has_value();
  if (!setup_.mission) {
    if (auto steps = record_.read_upload()) {
      setup_.mission = Mission{kUploaded, std::move(*steps)};
      is_uploaded_ = true;
      is_ordered_ = record_.read(*setup_.mission).has_value();
      log::info("has the mission that was uploaded before the restart; it was {}",
                is_ordered_ ? "started" : "not started");
      if (setup_.start_on_upload && !is_ordered_) starts_itself_at_ = listens_until_ + kUploadPause;
    }
  }
  if (!setup_.mission) return;
  if (station_) station_->set_mission(setup_.mission->steps, setup_.site);
  set_mission(std::move(*setup_.mission));
}

void MissionNode::set_mission(Mission mission) {
  log::info("{}: {} steps, from {} to {}", mission.file, mission.steps.size(), mission.steps.front().name,
            mission.steps.back().name);
  progress_.emplace(std::move(mission), setup_.config, setup_.uav.limits);
  progress_->set_following(following_, bus_.clock().now());
  if (state_) progress_->receive(*state_, bus_.clock().now());
  has_started_ = false;
  noted_.clear();
}

/// Only the first map is judged: a later one is the planner's affair. So a restarted process judges none.
void MissionNode::on_map(const MapChunk& chunk) {
  const bool is_first = !map_;
  if (!is_first && (!fences_ || is_flown())) return;
  const auto complete = assembler_.add(chunk);
  if (!complete || !*complete) return;
  map_ = assembler_.take();
  if (fences_) fences_->receive(*map_);
  if (is_first && progress_) judge_steps();
}

/// Uploaded fences may be replaced before the start: then, they judge the steps of an upload.
std::string MissionNode::why_blocked(const Mission& mission, bool is_uploaded) const {
  if (!fences_ || !is_uploaded) return steps_blocked(mission, *map_, setup_.uav.body);
  VoxelMap map = *map_;
  free_uploaded_fences(map);
  return steps_blocked(mission, map, setup_.uav.body);
}

void MissionNode::judge_steps() {
  const std::string blocked = why_blocked(progress_->mission(), is_uploaded_);
  if (blocked.empty()) return;
  if (record_.read(progress_->mission())) return log::warn("{}: {}", progress_->mission().file, blocked);
  log::error("{}: {}; move it, or correct map and fences", progress_->mission().file, blocked);
  if (is_uploaded_) return forget_mission();
  exit_code_ = kExitCannotFly;
}

void MissionNode::on_state(const UavState& state) {
  state_ = state;
  if (progress_) progress_->receive(state, bus_.received());
}

void MissionNode::on_goal(const Goal& goal) {
  if (goal.header.name.sender_epoch_us == bus_.epoch_us()) return;
  if (has_started_) return progress_->receive(goal, bus_.received());
  if (!heard_ || goal.id > heard_->id) heard_ = goal;
}

void MissionNode::on_predictions(const TrackSet& batch) {
  auto set = batches_.add(batch);
  const auto followed = progress_ ? progress_->followed_track() : std::nullopt;
  if (!set || !followed) return;
  const TrackSet whole = join_batches(std::move(*set));
  const auto track =
      std::find_if(whole.tracks.begin(), whole.tracks.end(), [&](const Track& t) { return t.id == *followed; });
  if (track == whole.tracks.end()) return;
  progress_->receive_track(track->motion.sample(bus_.received() + kFollowAhead).p, bus_.received());
}

std::string MissionNode::take_upload(const std::vector<Item>& items) {
  if (is_flown()) return kIsFlown;
  if (!map_) return kNoMap;
  if (items.empty()) {
    forget_mission();
    return "";
  }
  auto steps = steps_of(items, setup_.site);
  if (!steps) return steps.error().message;
  Mission mission{kUploaded, std::move(*steps)};
  for (const std::string& why : {steps_outside(mission, setup_.uav.flight_box, setup_.uav.body),
                                 steps_too_fast(mission, setup_.uav.limits), why_blocked(mission, true)}) {
    if (!why.empty()) return why;
  }
  record_.forget();
  if (!record_.write_upload(mission.steps)) log::error("the uploaded mission cannot be recorded; a restart loses it");
  station_->set_uploaded(mission.steps);
  set_mission(std::move(mission));
  is_ordered_ = false;
  is_fresh_ = is_uploaded_ = true;
  if (setup_.start_on_upload) starts_itself_at_ = bus_.clock().now() + kUploadPause;
  return "";
}

bool MissionNode::is_flown() const {
  return has_started_ && progress_->stand() != Stand::Done && progress_->stand() != Stand::Failed;
}

std::string MissionNode::take_fences(const std::vector<mavlink::MissionItemInt>& items) {
  if (is_flown()) return fences_->refuse(kIsFlown);
  if (!map_) return fences_->refuse(kNoMap);
  if (starts_itself_at_ != kNever) starts_itself_at_ = bus_.clock().now() + kUploadPause;
  return fences_->take(items, *map_, progress_ ? &progress_->mission() : nullptr, place());
}

std::string MissionNode::why_no_start() const {
  if (!fences_) return "";
  const std::string why = fences_->not_in_force();
  return why.empty() && progress_ ? fences_->why_beyond(&progress_->mission(), place()) : why;
}

void MissionNode::forget_mission() {
  record_.forget();
  progress_.reset();
  is_ordered_ = has_started_ = false;
  starts_itself_at_ = kNever;
  if (station_) station_->set_mission({}, setup_.site);
}

std::string MissionNode::obey(Order order) {
  const UTime now = bus_.clock().now();
  if (!progress_) return "there is no mission: upload one";
  switch (order) {
    case Order::Start:
      if (has_started_) return "the mission has already been started";
      if (std::string why = why_no_start(); !why.empty()) return why;
      is_ordered_ = true;
      starts_itself_at_ = kNever;
      return "";
    case Order::Pause: return has_started_ && progress_->pause(now) ? "" : "the mission is not being flown";
    case Order::GoOn: return has_started_ && progress_->go_on(now) ? "" : "the mission is not paused";
  }
  return "";
}

UTime MissionNode::next_wakeup() const {
  if (exit_code_) return kNever;
  UTime next = has_started_ ? progress_->next_wakeup() : std::max(listens_until_, next_hold_);
  next = std::min(next, starts_itself_at_);
  if (station_) next = std::min(next, station_->next_wakeup());
  if (fences_) next = std::min(next, fences_->next_wakeup());
  return next;
}

void MissionNode::step(UTime now) {
  if (exit_code_) return;
  if (station_) {
    station_->step(now);  // may replace or end progress_
    station_->report(now, progress_ ? &*progress_ : nullptr, state_ ? &*state_ : nullptr);
  }
  if (fences_) {
    for (const std::string& text : fences_->step(now)) {
      if (station_) station_->say(text);
    }
  }
  if (now >= starts_itself_at_) start_itself(now);
  if (!has_started_ && map_ && state_ && now >= listens_until_) begin(now);
  if (!has_started_) {
    if (now >= listens_until_ && !map_) listens_until_ = now + kListen;
    return;
  }
  note();
  if (const auto goal = progress_->due(now)) {
    if (const auto& limit = progress_->speed_limit()) bus_.publish(channels::kSpeedLimit, *limit);
    bus_.publish(channels::kGoal, *goal);
  }
}

/// Tries again after a while if the fences do not allow it.
void MissionNode::start_itself(UTime now) {
  const std::string why = obey(Order::Start);
  if (why.empty()) return;
  starts_itself_at_ = now + kUploadPause;
  if (why != std::exchange(no_start_, why)) station_->say("the mission does not start yet: " + why);
}

/// A restarted process that waits for its fences leaves the vehicle the goal that it has.
void MissionNode::begin(UTime now) {
  if (!is_ordered_) return hold(now);
  if (!fences_ || fences_->not_in_force().empty()) return start(now);
  if (!heard_) return hold(now);
  next_hold_ = now + kGoalPeriod;
}

void MissionNode::start(UTime now) {
  has_started_ = true;
  const auto remembered = is_fresh_ ? std::nullopt : record_.read(progress_->mission());
  const bool is_held = hold_ && (!heard_ || heard_->id <= hold_->id);
  std::optional<Goal> heard = is_held ? hold_ : heard_;
  // An upload begins at its first step: of the goal before, which may be another mission's, only the id counts.
  if (is_fresh_ && heard) heard->mode = GoalMode::Hold;
  progress_->start(heard, remembered, now);
  if (progress_->step() > 0 && progress_->stand() < Stand::Done) log::info("goes on at {}", progress_->text());
}

/// The planner needs a goal before the vehicle can take off.
void MissionNode::hold(UTime now) {
  if (now < next_hold_) return;
  next_hold_ = now + kGoalPeriod;
  if (!hold_) {
    hold_.emplace();
    hold_->id = goal_id(kNoStep, now, heard_ ? heard_->id : 0);
    hold_->mode = GoalMode::Hold;
  }
  bus_.publish(channels::kGoal, *hold_);
}

/// Records and logs what has changed.
void MissionNode::note() {
  std::string state = fmt::format("{} {}", static_cast<int>(progress_->stand()), progress_->step());
  for (const auto& at : progress_->reached()) state += at ? '1' : '0';
  if (state == std::exchange(noted_, state)) return;
  progress_->stand() == Stand::Failed ? log::error("{}", progress_->text()) : log::info("{}", progress_->text());
  if (record_.write(*progress_)) return;
  if (!std::exchange(has_failed_to_write_, true)) log::error("mission.json and mission.txt cannot be written");
}

NodeHealth MissionNode::health() const {
  if (!map_) return {ProcessState::Waiting, "a semantic map"};
  if (!state_) return {ProcessState::Waiting, "UAV_STATE"};
  if (fences_ && !is_flown()) {
    if (std::string why = fences_->not_in_force(); !why.empty()) return {ProcessState::Waiting, why};
  }
  if (!progress_) return {ProcessState::Ready, "waits for the ground station to upload a mission"};
  if (!is_ordered_) return {ProcessState::Ready, "waits for the ground station to start the mission"};
  if (!has_started_) return {ProcessState::Waiting, "the vehicle's goal, if an earlier process sent one"};
  switch (progress_->stand()) {
    case Stand::Done: return {ProcessState::Finished, progress_->text()};
    case Stand::Failed: return {ProcessState::Failed, progress_->text()};
    default: return {ProcessState::Ready, progress_->text()};
  }
}

}  // namespace tern::mission
