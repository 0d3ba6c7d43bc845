// The columns of tables that are made from messages: CSV files, arrays in Python.
#pragma once

#include <string>
#include <vector>

#include "ros_messages/message_types.h"

namespace tern::exporting {

/// Returns the columns of a table with a row per message: its fields without lists, in wire order. Nested fields are
/// joined by dots, elements of a fixed array by their index. The unit is added unless the field's name has it:
/// "motion.position.x [m]", "stage_ms.3".
std::vector<std::string> column_names(const ros::MessageType& type);
/// Returns the columns of a table with a row per element of a list.
std::vector<std::string> column_names(const ros::MessageField& list);

}  // namespace tern::exporting
