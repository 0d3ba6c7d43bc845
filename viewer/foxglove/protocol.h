// Foxglove's WebSocket protocol (https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md), the server's side.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/base/time.h"
#include "core/base/types.h"
#include "ros_messages/description.h"

namespace tern::foxglove {

/// The subprotocols, of which a client must offer one: that of the SDK, and that of the older client libraries.
inline constexpr const char* kSubprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// Limits of one client.
inline constexpr std::size_t kMaxClientMessageBytes = 64 << 10;
inline constexpr std::size_t kMaxSubscriptions = 256;
inline constexpr std::size_t kMaxAdvertised = 32;

/// The topic on which a client publishes a goal.
inline constexpr char kGoalTopic[] = "/goal_pose";

/// A topic that the server offers; its id is its index.
struct Channel {
  std::string topic;
  const ros::RosType* type = nullptr;
  bool latched = false;  ///< a new subscriber gets the newest message at once
};

/// The texts of clients. Ids are the client's own.
struct Subscribe {
  struct Entry {
    std::uint32_t subscription = 0, channel = 0;
  };
  std::vector<Entry> entries;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
struct ClientAdvertise {
  struct Entry {
    std::uint32_t channel = 0;
    std::string topic, encoding, schema_name;
  };
  std::vector<Entry> entries;
};
struct ClientUnadvertise {
  std::vector<std::uint32_t> channels;
};
/// An operation of the protocol that the server does not offer.
struct Unsupported {
  std::string operation;
};
using ClientText = std::variant<Subscribe, Unsubscribe, ClientAdvertise, ClientUnadvertise, Unsupported>;

/// Parses a client's text. Lists beyond the limits, numbers that are not ids and other forms are refused. Never throws.
Result<ClientText> parse_client_text(std::string_view json);

/// A message that a client published.
struct ClientMessage {
  std::uint32_t channel = 0;  ///< the client's own
  std::span<const std::uint8_t> payload;
};
/// Parses a client's binary message. @return an Error for other operations than publishing
Result<ClientMessage> parse_client_binary(std::span<const std::uint8_t> bytes);

/// The first text to a client. @param session  another one tells clients to forget all they know
std::string server_info(std::string_view session);
/// The second text: all channels.
std::string advertise(const std::vector<Channel>& channels);
enum class Level : std::uint8_t { Info = 0, Warning = 1, Error = 2 };
/// A text that the client shows to its user.
std::string status(Level level, std::string_view message);

/// The head of a binary message to a subscriber; the CDR bytes follow. Times before the epoch become 0.
std::string message_head(std::uint32_t subscription, UTime at);

/// Returns the position of a goal: geometry_msgs/PoseStamped as "cdr" or "json". The frame must be `frame` or empty,
/// and the numbers finite and within ±kMaxCoordinate.
Result<Vec3> goal_position(const ClientAdvertise::Entry& channel, std::span<const std::uint8_t> payload,
                           std::string_view frame);

}  // namespace tern::foxglove
