#include "mission/app/ground_station.h"

#include <cmath>
#include <utility>

#include "runtime/log.h"

namespace tern::mission {
namespace {

constexpr Duration kLookPeriod{20'000}, kReportPeriod{1'000'000}, kPlacePeriod{500'000};
constexpr int kPortionsPerLook = 100;
/// MAV_COMP_ID_AUTOPILOT1: ground stations send missions to this component.
constexpr std::uint8_t kComponent = 1;
/// MAV_TYPE_QUADROTOR, MAV_AUTOPILOT_GENERIC, MAV_STATE_ACTIVE, MAVLink 2 as HEARTBEAT states it.
constexpr std::uint8_t kQuadrotor = 2, kGeneric = 0, kActive = 4, kVersion = 3;
/// MAV_MODE_FLAG: custom mode and guided; armed.
constexpr std::uint8_t kReadyMode = 1 | 8, kArmed = 128;

/// MISSION_STATE
std::uint8_t state_of(const Progress* progress) {
  if (progress == nullptr) return 1;
  switch (progress->stand()) {
    case Stand::Waiting: return 2;
    case Stand::Flying:
    case Stand::Staying: return 3;
    case Stand::Paused:
    case Stand::Failed: return 4;
    case Stand::Done: return 5;
  }
  return 0;
}

bool is_flown(const Progress* progress) {
  const std::uint8_t state = state_of(progress);
  return state == 3 || state == 4;
}

/// The steps that are done.
int done_steps(const Progress* progress) {
  if (progress == nullptr) return 0;
  return progress->step() + (progress->stand() == Stand::Done ? 1 : 0);
}

}  // namespace

GroundStation::GroundStation(std::unique_ptr<mavlink::Link> link, std::uint8_t system, std::optional<LocalFrame> frame,
                             MissionTaker taker)
    : link_(std::move(link)), server_({system, kComponent}, std::move(taker)), frame_(std::move(frame)) {}

void GroundStation::send(const mavlink::Frame& frame) { link_->send(mavlink::to_bytes(frame)); }

void GroundStation::say(const std::string& text) {
  for (const mavlink::Frame& frame : server_.say(text)) send(frame);
}

void GroundStation::set_mission(const std::vector<Step>& steps, const Site& site) {
  server_.set_items(items_of(steps, site));
  seqs_ = seqs_of(steps);
}

/// Items count from 1, and seq from 0.
void GroundStation::set_uploaded(const std::vector<Step>& steps) {
  seqs_.clear();
  for (const Step& step : steps) seqs_.push_back(static_cast<std::uint16_t>(step.item - 1));
}

void GroundStation::step(UTime now) {
  if (now < next_look_) return;
  if (began_ == UTime{}) began_ = now;
  next_look_ = now + kLookPeriod;
  for (int k = 0; k < kPortionsPerLook; ++k) {  // of a flood, the rest waits in the socket's buffer
    const auto portion = link_->receive(now);
    if (!portion) break;
    for (const mavlink::Frame& frame : parser_.push(portion->bytes)) {
      for (const mavlink::Frame& answer : server_.receive(frame, now)) send(answer);
    }
    if (link_->datagrams()) parser_.drop_rest();
  }
  for (const mavlink::Frame& frame : server_.step(now)) send(frame);
  for (const std::string& line : link_->take_log_lines()) log::info("{}", line);
}

void GroundStation::report(UTime now, const Progress* progress, const UavState* state) {
  const auto seq_of = [&](int step) { return seqs_[idx(step)]; };
  if (now >= next_report_) {
    next_report_ = now + kReportPeriod;
    const auto mode = static_cast<std::uint8_t>(kReadyMode | (is_flown(progress) ? kArmed : 0));
    send(server_.frame_of(mavlink::Heartbeat{0, kQuadrotor, kGeneric, mode, kActive, kVersion}));
    mavlink::MissionCurrent current;
    current.seq = progress == nullptr ? std::uint16_t{0} : seq_of(progress->step());
    current.total = static_cast<std::uint16_t>(server_.items().size());
    current.mission_state = state_of(progress);
    send(server_.frame_of(current));
  }
  const int done = done_steps(progress);
  if (done > reported_done_) send(server_.frame_of(mavlink::MissionItemReached{seq_of(done - 1)}));
  reported_done_ = done;
  if (now < next_place_ || state == nullptr || !frame_) return;
  next_place_ = now + kPlacePeriod;
  const GeodeticPoint place = frame_->from_world(state->motion.p);
  mavlink::GlobalPositionInt at;
  at.time_boot_ms = static_cast<std::uint32_t>((now - began_).us / 1000);
  at.lat = static_cast<std::int32_t>(std::lround(place.latitude * 1e7));
  at.lon = static_cast<std::int32_t>(std::lround(place.longitude * 1e7));
  at.alt = static_cast<std::int32_t>(std::lround(place.height * 1e3));
  at.relative_alt = static_cast<std::int32_t>(std::lround((place.height - frame_->origin().height) * 1e3));
  send(server_.frame_of(at));
}

}  // namespace tern::mission
