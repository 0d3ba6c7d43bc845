#include "viewer/foxglove/protocol.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/wire/message_limits.h"
#include "ros_messages/types.h"

namespace tern::foxglove {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint8_t kMessageData = 1;  ///< binary operation: server to client, and client to server
constexpr char kPoseStamped[] = "geometry_msgs/msg/PoseStamped", kPoseStampedShort[] = "geometry_msgs/PoseStamped";

/// Thrown and caught in this file only.
struct Refused {
  std::string why;
};

std::uint32_t id_of(const Json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    throw Refused{"an id is not 0 ... 2^32 - 1"};
  return value.get<std::uint32_t>();
}

std::string text_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_string()) throw Refused{fmt::format("{} is missing or not a text", name)};
  return found->get<std::string>();
}

const Json& member(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) throw Refused{fmt::format("{} is missing", name)};
  return *found;
}

const Json& list_of(const Json& object, const char* name, std::size_t most) {
  const Json& list = member(object, name);
  if (!list.is_array()) throw Refused{fmt::format("{} is not a list", name)};
  if (list.size() > most) throw Refused{fmt::format("{} has more than {} entries", name, most)};
  return list;
}

std::vector<std::uint32_t> ids_of(const Json& object, const char* name, std::size_t most) {
  std::vector<std::uint32_t> ids;
  for (const Json& id : list_of(object, name, most)) ids.push_back(id_of(id));
  return ids;
}

ClientText parsed(const Json& object) {
  if (!object.is_object()) throw Refused{"not an object"};
  const std::string operation = text_of(object, "op");
  if (operation == "subscribe") {
    Subscribe subscribe;
    for (const Json& entry : list_of(object, "subscriptions", kMaxSubscriptions)) {
      if (!entry.is_object()) throw Refused{"a subscription is not an object"};
      subscribe.entries.push_back({id_of(member(entry, "id")), id_of(member(entry, "channelId"))});
    }
    return subscribe;
  }
  if (operation == "unsubscribe") return Unsubscribe{ids_of(object, "subscriptionIds", kMaxSubscriptions)};
  if (operation == "unadvertise") return ClientUnadvertise{ids_of(object, "channelIds", kMaxAdvertised)};
  if (operation != "advertise") return Unsupported{operation};
  ClientAdvertise advertise;
  for (const Json& entry : list_of(object, "channels", kMaxAdvertised)) {
    if (!entry.is_object()) throw Refused{"a channel is not an object"};
    advertise.entries.push_back({id_of(member(entry, "id")), text_of(entry, "topic"), text_of(entry, "encoding"),
                                 text_of(entry, "schemaName")});
  }
  return advertise;
}

template <class Integer>
void append(std::string& bytes, Integer x) {
  for (std::size_t k = 0; k < sizeof x; ++k) bytes += static_cast<char>(x >> (8 * k) & 0xFFU);
}

struct FramedPoint {
  std::string frame;
  Vec3 position;
};

std::optional<FramedPoint> read_cdr(std::span<const std::uint8_t> payload) {
  const auto pose = ros::decode_cdr<ros::PoseStamped>(payload);
  if (!pose) return std::nullopt;
  const ros::Point& p = pose->pose.position;
  return FramedPoint{pose->header.frame_id, {p.x, p.y, p.z}};
}

std::optional<FramedPoint> read_json(std::span<const std::uint8_t> payload) {
  const Json json = Json::parse(payload.begin(), payload.end(), nullptr, false);
  const Json* const position = json.is_object() && json.contains("pose") && json["pose"].is_object() &&
                                       json["pose"].contains("position") && json["pose"]["position"].is_object()
                                   ? &json["pose"]["position"]
                                   : nullptr;
  if (position == nullptr) return std::nullopt;
  FramedPoint read;
  for (int axis = 0; axis < 3; ++axis) {
    const auto found = position->find(std::string(1, "xyz"[axis]));
    if (found == position->end() || !found->is_number()) return std::nullopt;
    read.position[axis] = found->get<double>();
  }
  if (json.contains("header") && json["header"].is_object() && json["header"].contains("frame_id")) {
    if (!json["header"]["frame_id"].is_string()) return std::nullopt;
    read.frame = json["header"]["frame_id"].get<std::string>();
  }
  return read;
}

}  // namespace

Result<ClientText> parse_client_text(std::string_view json) {
  try {
    return parsed(Json::parse(json));
  } catch (const Refused& refused) {
    return fail(refused.why);
  } catch (const Json::exception&) {
    return fail("not JSON");
  }
}

Result<ClientMessage> parse_client_binary(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHeadBytes = 5;
  if (bytes.size() < kHeadBytes || bytes[0] != kMessageData) return fail("not a published message");
  std::uint32_t channel = 0;
  for (std::size_t k = 0; k < sizeof channel; ++k) channel |= std::uint32_t{bytes[1 + k]} << (8 * k);
  return ClientMessage{channel, bytes.subspan(kHeadBytes)};
}

std::string server_info(std::string_view session) {
  // By ROS_DISTRO Foxglove knows that poses are to be published with ROS 2's types.
  return Json{{"op", "serverInfo"},
              {"name", "tern-viewer"},
              {"capabilities", {"clientPublish"}},
              {"supportedEncodings", {"cdr", "json"}},
              {"metadata", {{"ROS_DISTRO", "jazzy"}}},
              {"sessionId", session}}
      .dump();
}

std::string advertise(const std::vector<Channel>& channels) {
  Json list = Json::array();
  for (std::size_t id = 0; id < channels.size(); ++id) {
    list.push_back({{"id", id},
                    {"topic", channels[id].topic},
                    {"encoding", "cdr"},
                    {"schemaName", channels[id].type->name()},
                    {"schema", channels[id].type->definition()},
                    {"schemaEncoding", "ros2msg"}});
  }
  return Json{{"op", "advertise"}, {"channels", list}}.dump();
}

std::string status(Level level, std::string_view message) {
  return Json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}}.dump(
      -1, ' ', false, Json::error_handler_t::replace);
}

std::string message_head(std::uint32_t subscription, UTime at) {
  std::string head(1, static_cast<char>(kMessageData));
  append(head, subscription);
  append(head, static_cast<std::uint64_t>(std::max<std::int64_t>(at.us, 0)) * 1000);
  return head;
}

Result<Vec3> goal_position(const ClientAdvertise::Entry& channel, std::span<const std::uint8_t> payload,
                           std::string_view frame) {
  if (channel.topic != kGoalTopic) return fail(fmt::format("goals are published on {}", kGoalTopic));
  if (channel.schema_name != kPoseStamped && channel.schema_name != kPoseStampedShort) {
    return fail(fmt::format("a goal is a {}", kPoseStamped));
  }
  const auto read = channel.encoding == "cdr"    ? read_cdr(payload)
                    : channel.encoding == "json" ? read_json(payload)
                                                 : std::nullopt;
  if (!read) return fail(fmt::format("the message is not a {} in cdr or json", kPoseStamped));
  if (!read->frame.empty() && read->frame != frame) {
    return fail(fmt::format("the goal is in another frame than {}", frame));
  }
  const bool is_sane = read->position.allFinite() && read->position.cwiseAbs().maxCoeff() <= kMaxCoordinate;
  if (!is_sane) return fail("the goal's position is not finite");
  return read->position;
}

}  // namespace tern::foxglove
