// Names of DimOS's channels and types.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace tern::dimos {

/// LCM's limit on the name of a channel, bytes.
inline constexpr std::size_t kMaxChannelBytes = 63;

/// The name of a type: "nav_msgs/msg/Path" is "nav_msgs.Path".
std::string type_name(std::string_view ros_type);

/// Returns the type of a channel as DimOS writes it: that of "/odom#geometry_msgs.PoseStamped" is
/// "geometry_msgs.PoseStamped".
/// @param types  allowed ones
/// @return an Error that says what is wrong with the name
Result<std::string> type_of_channel(std::string_view channel, const std::vector<std::string>& types);

/// Returns a channel as LCM subscribes it: a pattern that matches this name alone.
std::string pattern_of(std::string_view channel);

}  // namespace tern::dimos
