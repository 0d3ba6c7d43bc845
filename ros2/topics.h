// The topics of the bridge: their types and their quality of service.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ros2/dds/participant.h"
#include "ros_messages/feed.h"

namespace tern::ros2 {

namespace topics {
using namespace ros::topics;
inline constexpr char kClock[] = "/clock", kTfStatic[] = "/tf_static", kCloud[] = "/cloud", kFollowing[] = "/following",
                      kOctomap[] = "/octomap_binary";
}  // namespace topics

/// The topics that tern-ros2 can send: those of the feed, drawings as markers, and /clock.
const std::vector<ros::FeedTopic>& sent_topics();
/// The topics that it can receive on demand. With one of them it also receives /tf and /tf_static.
const std::vector<ros::FeedTopic>& received_topics();
/// /tf and /tf_static.
const std::vector<ros::FeedTopic>& transform_topics();

/// A writer is reliable, which fits every reader; a latched one keeps its newest message for later readers.
Qos writer_qos(const ros::FeedTopic& topic);
/// A reader is content with the best effort, which fits every writer. Goals are sent once, so their reader is reliable.
/// /tf_static and the OctoMap are latched and reliable, as their writers are.
Qos reader_qos(const ros::FeedTopic& topic);

/// Returns the user data of a reader or writer: the hash of its type, as rmw reads it.
/// @param sha256  of ros::hashed_description, hexadecimal
std::string user_data(std::string_view sha256);

}  // namespace tern::ros2
