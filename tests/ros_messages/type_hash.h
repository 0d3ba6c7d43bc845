// The hash RIHS01 of a ROS message type (REP-2016): two types have the same one only if all names and types of their
// fields agree.
#pragma once

#include <string>

#include "ros_messages/description.h"

namespace tern::testing {

/// Returns "RIHS01_" and the SHA-256 of the type's description as JSON, as rosidl makes it.
std::string type_hash(const ros::RosType& type);

}  // namespace tern::testing
