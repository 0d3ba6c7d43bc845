#include "ros_messages/description.h"

#include <fmt/format.h>

namespace tern::ros {
namespace {

using Form = FieldDescription::Form;

/// "geometry_msgs/msg/Point" → "geometry_msgs/Point", as .msg files name types.
std::string short_name(const std::string& type) {
  const std::size_t slash = type.find("/msg/");
  return slash == std::string::npos ? type : type.substr(0, slash) + type.substr(slash + 4);
}

std::string lines_of(const TypeDescription& type) {
  std::string text;
  for (const FieldDescription& field : type.fields) {
    const std::string brackets = field.form == Form::Array      ? fmt::format("[{}]", field.size)
                                 : field.form == Form::Sequence ? "[]"
                                                                : "";
    text += fmt::format("{}{} {}", short_name(field.type), brackets, field.name);
    text += field.comment.empty() ? "\n" : fmt::format("  # {}\n", field.comment);
  }
  return text;
}

}  // namespace

std::string RosType::definition() const {
  std::string text = lines_of(types.front());
  for (std::size_t k = 1; k < types.size(); ++k) {
    text += fmt::format("{:=<80}\nMSG: {}\n{}", "", short_name(types[k].name), lines_of(types[k]));
  }
  return text;
}

}  // namespace tern::ros
