// A type of Cyclone DDS whose samples are bytes: the CDR of a message, as a std::string.
#pragma once

#include <string>

struct ddsi_sertype;

namespace tern::ros2 {

/// Returns a type without key for dds_create_topic_sertype, which takes it over. Samples of dds_write and dds_take are
/// std::string: the header of four bytes, then the fields. Bytes are neither read nor checked here.
/// @param name  as on the wire: "nav_msgs::msg::dds_::Odometry_"
ddsi_sertype* make_cdr_type(const std::string& name);

}  // namespace tern::ros2
