#include "tools/export/message_types.h"

#include <array>
#include <cctype>
#include <regex>
#include <sstream>

namespace tern::exporting {

namespace {

constexpr std::array kUnits{"m", "m/s", "m/s^2", "m/s^3", "rad", "s", "m^2", "kB", "m^2/s^5", "m^2/s^6", "ms", "us"};

bool name_says_unit(const std::string& name) {
  return name.ends_with("_us") || name.ends_with("_ms") || name.ends_with("_kb");
}

/// The first of a comment's parts ("centre, W, m, each |.| <= 1e6") that is a unit; "m/s per axis" is one.
std::string unit_in(const std::string& comment) {
  std::istringstream parts(comment);
  for (std::string part; std::getline(parts, part, ',');) {
    part.erase(0, part.find_first_not_of(' '));
    for (const std::string unit : kUnits) {
      if (part == unit || part.starts_with(unit + " per ")) return unit;
    }
  }
  return "";
}

MessageField field_of(const std::smatch& match) {
  MessageField field;
  field.type = match[1];
  field.name = match[2];
  field.comment = match[4];
  field.digest = field.type == "int64_t" && field.comment.find("unsigned") != std::string::npos;
  if (!name_says_unit(field.name)) field.unit = unit_in(field.comment);
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
    above = is_comment ? above + (above.empty() ? "" : " ") + line.substr(3) : "";
  }
  return types;
}

const MessageTypes& message_types() {
  static const MessageTypes kTypes = parse_definitions(kDefinitions);
  return kTypes;
}

}  // namespace tern::exporting
