// The definitions of Tern's messages (ros_messages/message_types.h) for the tables of this folder.
#pragma once

#include "ros_messages/message_types.h"

namespace tern::exporting {

using ros::message_types;
using ros::MessageField;
using ros::MessageType;

}  // namespace tern::exporting
