#include "ros_messages/message_types.h"

#include <fmt/format.h>

#include <cctype>
#include <regex>
#include <sstream>

namespace tern::ros {

namespace {

MessageField field_of(const std::smatch& match) {
  MessageField field;
  field.type = match[1];
  field.name = match[2];
  field.comment = match[4];
  if (field.comment.starts_with('[')) field.unit = field.comment.substr(1, field.comment.find(']') - 1);
  field.digest = field.unit == "digest";
  if (field.digest) field.unit = "";
  const std::string size = match[3];
  if (size.empty()) return field;
  if (std::isdigit(static_cast<unsigned char>(size.front())) != 0) {
    field.form = MessageField::Form::FixedArray;
    field.size = std::stoi(size);
  } else {
    field.form = field.type == "byte" ? MessageField::Form::Text : MessageField::Form::List;
    field.count = size;
  }
  return field;
}

}  // namespace

MessageTypes parse_definitions(std::string_view text) {
  static const std::regex kStruct(R"(struct (\w+) \{)");
  static const std::regex kField(R"( +(\w+) (\w+)(?:\[(\w+)\])?; *(?:// *(.*))?)");
  MessageTypes types;
  MessageType* open = nullptr;
  std::istringstream lines{std::string(text)};
  std::string above;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kStruct)) {
      open = &types[match[1]];
      open->name = match[1];
      open->comment = above;
    } else if (open != nullptr && std::regex_match(line, match, kField)) {
      open->fields.push_back(field_of(match));
    }
    const bool is_comment = line.starts_with("// ");
    above = is_comment ? fmt::format("{}{}{}", above, above.empty() ? "" : " ", line.substr(3)) : "";
  }
  return types;
}

const MessageTypes& message_types() {
  static const MessageTypes kTypes = parse_definitions(kDefinitions);
  return kTypes;
}

}  // namespace tern::ros
