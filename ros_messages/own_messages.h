// Tern's own messages as ROS messages: "plan_t" of lcmtypes/ is "tern_msgs/msg/Plan", with the same fields.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ros_messages/description.h"

namespace tern::ros {

/// Returns the ROS type of one of Tern's message types. Units and comments stay in its definition. A text is a string,
/// a digest a uint64. @throws std::out_of_range if the type is unknown
const RosType& own_type(std::string_view lcm_type);

/// Converts a message that decode() (messages/codec.h) accepts from LCM's encoding to CDR.
/// @throws std::out_of_range if the type is unknown, or the bytes are too few for its fields
std::string own_cdr(std::string_view lcm_type, std::span<const std::uint8_t> bytes);

}  // namespace tern::ros
