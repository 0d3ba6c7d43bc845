#include "mission/upload/mission_server.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tern::mission {
namespace {

using namespace mavlink;

constexpr std::uint16_t kPauseContinue = 193, kMissionStart = 300, kRequestMessage = 512;
/// MAV_PROTOCOL_CAPABILITY
constexpr std::uint64_t kMissionInt = 4, kMavlink2 = 8192, kMissionFence = 16384;
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
      handle<MissionRequestList>(frame, [&](const auto& m) { send_count(m.mission_type, peer, out); }) ||
      handle<MissionClearAll>(frame, [&](const auto& m) { on_clear(m.mission_type, peer, out); }) ||
      handle<MissionAck>(frame,
                         [&](const auto& m) {
                           if (upload_ && upload_->peer == peer && m.type == kCancelled) upload_.reset();
                         }) ||
      handle<CommandLong>(frame, [&](const auto& m) { on_command(m, peer, out); });
  return out;
}

bool MissionServer::is_supported(std::uint8_t type) const {
  return type == kMissionType || (type == kFenceType && taker_.no_fences.empty());
}

std::string MissionServer::hand_over(std::uint8_t type, std::vector<MissionItemInt> wire) {
  std::string why;
  if (type == kFenceType) {
    why = taker_.take_fences(wire);
  } else {
    std::vector<Item> items;
    items.reserve(wire.size());
    for (const MissionItemInt& item : wire) items.push_back(item_of(item));
    why = taker_.take(items);
  }
  if (why.empty()) stored_[type] = std::move(wire);
  return why;
}

void MissionServer::on_clear(std::uint8_t type, Address peer, Frames& out) {
  std::string why;
  for (const std::uint8_t each : {kMissionType, kFenceType}) {
    if (!why.empty() || !is_supported(each) || (type != each && type != kAllTypes)) continue;
    why = hand_over(each, {});
    if (why.empty() && ended_ && ended_->type == each) ended_.reset();
  }
  if (!why.empty()) say(why, out);
  acknowledge(why.empty() ? kAccepted : kDenied, type, peer, out);
}

void MissionServer::on_count(const MissionCount& count, Address peer, UTime now, Frames& out) {
  const std::uint8_t type = count.mission_type;
  if (!is_supported(type)) {
    if (count.count > 0) say(type == kFenceType ? taker_.no_fences : "rally points cannot be uploaded", out);
    return acknowledge(count.count > 0 ? kUnsupported : kAccepted, type, peer, out);
  }
  if (upload_ && upload_->peer != peer) return acknowledge(kDenied, type, peer, out);
  if (type == kFenceType) taker_.await_fences();
  if (count.count > kMaxUploadedItems) return acknowledge(kNoSpace, type, peer, out);
  upload_ = Upload{peer, type, count.count, {}, now, 0};
  count.count == 0 ? finish(peer, out) : request(now, out);
}

void MissionServer::on_item(const MissionItemInt& item, Address peer, UTime now, Frames& out) {
  const bool is_last_again = !upload_ && ended_ && ended_->peer == peer && ended_->type == item.mission_type &&
                             item.seq + std::size_t{1} == ended_->count;
  if (is_last_again) return acknowledge(ended_->result, ended_->type, peer, out);
  if (!upload_ || upload_->peer != peer || upload_->type != item.mission_type) return;
  if (item.seq == upload_->items.size()) {
    upload_->items.push_back(item);
    upload_->tries = 0;
  }
  upload_->items.size() == upload_->count ? finish(peer, out) : request(now, out);
}

void MissionServer::finish(Address peer, Frames& out) {
  Upload upload = *std::exchange(upload_, std::nullopt);
  const std::string why = hand_over(upload.type, std::move(upload.items));
  ended_ = Ended{peer, upload.type, upload.count, why.empty() ? kAccepted : kInvalid};
  if (!why.empty()) say(why, out);
  acknowledge(ended_->result, upload.type, peer, out);
}

void MissionServer::request(UTime now, Frames& out) {
  upload_->asked = now;
  ++upload_->tries;
  out.push_back(frame_of(MissionRequestInt{static_cast<std::uint16_t>(upload_->items.size()), upload_->peer.system,
                                           upload_->peer.component, upload_->type}));
}

std::vector<Frame> MissionServer::step(UTime now) {
  Frames out;
  if (!upload_ || now - upload_->asked < kRequestAgain) return out;
  if (upload_->tries >= kTries) {
    acknowledge(kCancelled, upload_->type, upload_->peer, out);
    upload_.reset();
    return out;
  }
  request(now, out);
  return out;
}

void MissionServer::send_count(std::uint8_t type, Address peer, Frames& out) {
  if (!is_supported(type)) return acknowledge(kUnsupported, type, peer, out);
  out.push_back(
      frame_of(MissionCount{static_cast<std::uint16_t>(stored_[type].size()), peer.system, peer.component, type, 0}));
}

void MissionServer::send_item(std::uint16_t seq, std::uint8_t type, Address peer, Frames& out) {
  if (!is_supported(type)) return acknowledge(kUnsupported, type, peer, out);
  if (seq >= stored_[type].size()) return acknowledge(kInvalidSequence, type, peer, out);
  MissionItemInt item = stored_[type][seq];
  item.mission_type = type;
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
  const bool asks_for_abilities =
      command.command == kRequestMessage && command.param[0] == static_cast<float>(AutopilotVersion::kId);
  if (asks_for_abilities) ack.result = kResultAccepted;
  out.push_back(frame_of(ack));
  if (asks_for_abilities) out.push_back(frame_of(abilities()));
}

AutopilotVersion MissionServer::abilities() const {
  AutopilotVersion version;
  version.capabilities = kMissionInt | kMavlink2 | (is_supported(kFenceType) ? kMissionFence : 0);
  return version;
}

void MissionServer::acknowledge(std::uint8_t result, std::uint8_t type, Address peer, Frames& out) {
  out.push_back(frame_of(MissionAck{peer.system, peer.component, result, type, 0}));
}

std::vector<Frame> MissionServer::say(const std::string& text) {
  Frames out;
  say(text, out);
  return out;
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
