// The hash RIHS01 of a ROS message type (REP-2016): two types have the same one only if all names and types of their
// fields agree.
#pragma once

#include <string>

#include "ros_messages/description.h"

namespace tern::ros {

/// Returns the text that is hashed: the type's description as JSON, as rosidl writes it. The hash is "RIHS01_" and the
/// SHA-256 of this text in hexadecimal digits.
std::string hashed_description(const RosType& type);

}  // namespace tern::ros
