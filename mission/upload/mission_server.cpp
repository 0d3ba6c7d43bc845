#include "mission/upload/mission_server.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tern::mission {
namespace {

using namespace mavlink;

/// MAV_MISSION_TYPE
constexpr std::uint8_t kMissionType = 0, kAllTypes = 255;
constexpr std::uint16_t kPauseContinue = 193, kMissionStart = 300;
/// MAV_RESULT
constexpr std::uint8_t kResultAccepted = 0, kResultDenied = 2, kResultUnsupported = 3;
constexpr std::uint8_t kFrameEnu = 4, kFrameRelativeInt = 6, kFrameMission = 2;
constexpr std::uint16_t kNavWaypoint = 16, kDoChangeSpeed = 178;
/// Parameters of DO_CHANGE_SPEED: the kind of speed, the vehicle's own speed, the throttle.
constexpr float kGroundSpeed = 1.0F, kDefaultSpeed = -2.0F, kUnchanged = -1.0F;
constexpr double kDegreesPerUnit = 1e-7, kMetresPerUnit = 1e-4;
constexpr std::size_t kTextBytes = 50;
constexpr std::size_t kMaxSaid = 500;

}  // namespace

Item item_of(const MissionItemInt& wire) {
  constexpr std::int32_t kNotGiven = std::numeric_limits<std::int32_t>::max();
  Item item;
  item.number = wire.seq + 1;
  item.command = wire.command;
  item.frame = wire.frame;
  for (std::size_t k = 0; k < item.params.size(); ++k) item.params[k] = static_cast<double>(wire.param[k]);
  const bool is_local = wire.frame == 1 || wire.frame == kFrameEnu;
  const double unit = is_local ? kMetresPerUnit : kDegreesPerUnit;
  if (wire.x != kNotGiven && wire.y != kNotGiven && wire.frame != kFrameMission) {
    item.x = unit * wire.x;
    item.y = unit * wire.y;
  }
  item.z = static_cast<double>(wire.z);
  item.goes_on = wire.autocontinue != 0;
  return item;
}

std::vector<MissionItemInt> items_of(const std::vector<Step>& steps, const Site& site) {
  std::vector<MissionItemInt> items;
  double speed = 0.0;
  const auto next = [&items](std::uint16_t command) {
    MissionItemInt item;
    item.seq = static_cast<std::uint16_t>(items.size());
    item.command = command;
    item.autocontinue = 1;
    return item;
  };
  for (const Step& step : steps) {
    if (step.action == Action::Follow) continue;
    if (step.speed != std::exchange(speed, step.speed)) {
      MissionItemInt change = next(kDoChangeSpeed);
      change.frame = kFrameMission;
      change.param = {kGroundSpeed, step.speed > 0.0 ? static_cast<float>(step.speed) : kDefaultSpeed, kUnchanged,
                      0.0F};
      items.push_back(change);
    }
    MissionItemInt item = next(kNavWaypoint);
    item.param = {static_cast<float>(step.hold_s), static_cast<float>(step.radius), 0.0F,
                  std::numeric_limits<float>::quiet_NaN()};
    if (site.frame) {
      const GeodeticPoint place = site.frame->from_world(step.position);
      item.frame = kFrameRelativeInt;
      item.x = static_cast<std::int32_t>(std::lround(place.latitude / kDegreesPerUnit));
      item.y = static_cast<std::int32_t>(std::lround(place.longitude / kDegreesPerUnit));
      item.z = static_cast<float>(place.height - site.frame->origin().height);
    } else {
      item.frame = kFrameEnu;
      item.x = static_cast<std::int32_t>(std::lround(step.position.x() / kMetresPerUnit));
      item.y = static_cast<std::int32_t>(std::lround(step.position.y() / kMetresPerUnit));
      item.z = static_cast<float>(step.position.z());
    }
    items.push_back(item);
  }
  return items;
}

std::vector<std::uint16_t> seqs_of(const std::vector<Step>& steps) {
  std::vector<std::uint16_t> seqs;
  std::uint16_t next = 0;
  double speed = 0.0;
  for (const Step& step : steps) {
    const bool has_item = step.action != Action::Follow;
    if (has_item && step.speed != std::exchange(speed, step.speed)) ++next;
    seqs.push_back(next);
    if (has_item) ++next;
  }
  return seqs;
}

bool MissionServer::is_for_me(std::uint8_t system, std::uint8_t component) const {
  return (system == 0 || system == self_.system) && (component == 0 || component == self_.component);
}

template <class M, class Handle>
bool MissionServer::handle(const Frame& frame, const Handle& with) {
  const auto message = from_frame<M>(frame);
  if (!message) return false;
  if (is_for_me(message->target_system, message->target_component)) with(*message);
  return true;
}

std::vector<Frame> MissionServer::receive(const Frame& frame, UTime now) {
  Frames out;
  const Address peer = frame.from;
  handle<MissionCount>(frame, [&](const auto& m) { on_count(m, peer, now, out); }) ||
      handle<MissionItemInt>(frame, [&](const auto& m) { on_item(m, peer, now, out); }) ||
      handle<MissionRequestInt>(frame, [&](const auto& m) { send_item(m.seq, m.mission_type, peer, out); }) ||
      handle<MissionRequest>(frame, [&](const auto& m) { send_item(m.seq, m.mission_type, peer, out); }) ||
      handle<MissionRequestList>(frame,
                                 [&](const auto& m) {
                                   if (m.mission_type != kMissionType) {
                                     return acknowledge(kUnsupported, m.mission_type, peer, out);
                                   }
                                   out.push_back(frame_of(MissionCount{static_cast<std::uint16_t>(items_.size()),
                                                                       peer.system, peer.component, kMissionType, 0}));
                                 }) ||
      handle<MissionClearAll>(frame,
                              [&](const auto& m) {
                                const bool clears = m.mission_type == kMissionType || m.mission_type == kAllTypes;
                                const std::string why = clears ? taker_.take({}) : "";
                                if (why.empty() && clears) {
                                  items_.clear();
                                  ended_.reset();
                                }
                                if (!why.empty()) say(why, out);
                                acknowledge(why.empty() ? kAccepted : kDenied, m.mission_type, peer, out);
                              }) ||
      handle<MissionAck>(frame,
                         [&](const auto& m) {
                           if (upload_ && upload_->peer == peer && m.type == kCancelled) upload_.reset();
                         }) ||
      handle<CommandLong>(frame, [&](const auto& m) { on_command(m, peer, out); });
  return out;
}

void MissionServer::on_count(const MissionCount& count, Address peer, UTime now, Frames& out) {
  if (count.mission_type != kMissionType) {
    if (count.count > 0) say("fences and rally points cannot be uploaded; state fences in the scenario", out);
    return acknowledge(count.count > 0 ? kUnsupported : kAccepted, count.mission_type, peer, out);
  }
  if (upload_ && upload_->peer != peer) return acknowledge(kDenied, kMissionType, peer, out);
  if (count.count > kMaxUploadedItems) return acknowledge(kNoSpace, kMissionType, peer, out);
  upload_ = Upload{peer, count.count, {}, now, 0};
  count.count == 0 ? finish(peer, out) : request(now, out);
}

void MissionServer::on_item(const MissionItemInt& item, Address peer, UTime now, Frames& out) {
  if (item.mission_type != kMissionType) return;
  const bool is_last_again = !upload_ && ended_ && ended_->peer == peer && item.seq + std::size_t{1} == ended_->count;
  if (is_last_again) return acknowledge(ended_->result, kMissionType, peer, out);
  if (!upload_ || upload_->peer != peer) return;
  if (item.seq == upload_->items.size()) {
    upload_->items.push_back(item);
    upload_->tries = 0;
  }
  upload_->items.size() == upload_->count ? finish(peer, out) : request(now, out);
}

void MissionServer::finish(Address peer, Frames& out) {
  std::vector<Item> items;
  for (const MissionItemInt& item : upload_->items) items.push_back(item_of(item));
  const std::string why = taker_.take(items);
  ended_ = Ended{peer, upload_->count, why.empty() ? kAccepted : kInvalid};
  if (why.empty()) items_ = std::move(upload_->items);
  upload_.reset();
  if (!why.empty()) say(why, out);
  acknowledge(ended_->result, kMissionType, peer, out);
}

void MissionServer::request(UTime now, Frames& out) {
  upload_->asked = now;
  ++upload_->tries;
  out.push_back(frame_of(MissionRequestInt{static_cast<std::uint16_t>(upload_->items.size()), upload_->peer.system,
                                           upload_->peer.component, kMissionType}));
}

std::vector<Frame> MissionServer::step(UTime now) {
  Frames out;
  if (!upload_ || now - upload_->asked < kRequestAgain) return out;
  if (upload_->tries >= kTries) {
    acknowledge(kCancelled, kMissionType, upload_->peer, out);
    upload_.reset();
    return out;
  }
  request(now, out);
  return out;
}

void MissionServer::send_item(std::uint16_t seq, std::uint8_t type, Address peer, Frames& out) {
  if (type != kMissionType) return acknowledge(kUnsupported, type, peer, out);
  if (seq >= items_.size()) return acknowledge(kInvalidSequence, type, peer, out);
  MissionItemInt item = items_[seq];
  item.target_system = peer.system;
  item.target_component = peer.component;
  out.push_back(frame_of(item));
}

void MissionServer::on_command(const CommandLong& command, Address peer, Frames& out) {
  CommandAck ack;
  ack.command = command.command;
  ack.result = kResultUnsupported;
  ack.target_system = peer.system;
  ack.target_component = peer.component;
  if (command.command == kMissionStart || command.command == kPauseContinue) {
    const bool is_pause = command.param[0] == 0.0F;
    const Order order = command.command == kMissionStart ? Order::Start : is_pause ? Order::Pause : Order::GoOn;
    const bool asks_for_part = order == Order::Start &&
                               (command.param[0] > 0.0F || (command.param[1] > 0.0F && command.param[1] < last_item()));
    const std::string why =
        asks_for_part ? "a mission is flown whole; leave first_item and last_item 0" : taker_.obey(order);
    ack.result = why.empty() ? kResultAccepted : kResultDenied;
    if (!why.empty()) say(why, out);
  }
  out.push_back(frame_of(ack));
}

void MissionServer::acknowledge(std::uint8_t result, std::uint8_t type, Address peer, Frames& out) {
  out.push_back(frame_of(MissionAck{peer.system, peer.component, result, type, 0}));
}

void MissionServer::say(const std::string& text, Frames& out) {
  constexpr std::uint8_t kWarning = 4;
  const std::string words = printable(text.substr(0, kMaxSaid));
  ++text_id_;
  std::uint8_t chunk = 0;
  // A text of exactly one or more full chunks ends with an empty one.
  for (std::size_t at = 0; at <= words.size(); at += kTextBytes) {
    const bool is_short = words.size() < kTextBytes;
    out.push_back(frame_of(StatusText{kWarning, text_of<kTextBytes>(words.substr(at, kTextBytes)),
                                      is_short ? std::uint16_t{0} : text_id_, chunk++}));
  }
}

}  // namespace tern::mission
