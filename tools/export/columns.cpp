#include "tools/export/columns.h"

#include <fmt/format.h>

namespace tern::exporting {
namespace {

using ros::message_types;
using ros::MessageField;
using ros::MessageType;
using Form = MessageField::Form;
using Names = std::vector<std::string>;

void append(Names& names, const std::string& name, const MessageField& field, const std::string& unit);

/// @param prefix  "" or ends with a dot
void append(Names& names, const std::string& prefix, const MessageType& type, const std::string& unit) {
  for (const MessageField& field : type.fields) {
    const std::string own = field.unit.empty() ? unit : field.unit;
    if (field.form == Form::FixedArray) {
      for (int k = 0; k < field.size; ++k) append(names, fmt::format("{}{}.{}", prefix, field.name, k), field, own);
    } else if (field.form != Form::List) {
      append(names, prefix + field.name, field, own);
    }
  }
}

void append(Names& names, const std::string& name, const MessageField& field, const std::string& unit) {
  const auto nested = message_types().find(field.type);
  if (nested != message_types().end()) {
    append(names, name.empty() ? "" : name + ".", nested->second, unit);
  } else {
    names.push_back((name.empty() ? field.name : name) + (unit.empty() ? "" : " [" + unit + "]"));
  }
}

}  // namespace

std::vector<std::string> column_names(const MessageType& type) {
  Names names;
  append(names, "", type, "");
  return names;
}

std::vector<std::string> column_names(const MessageField& list) {
  Names names;
  append(names, "", list, list.unit);
  return names;
}

}  // namespace tern::exporting
