// The definitions in lcmtypes/*.lcm: fields in wire order, with units and comments.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tern::ros {

/// A field of a message type.
struct MessageField {
  enum class Form { Value, FixedArray, List, Text };

  std::string name;
  std::string type;     ///< an LCM primitive, or the name of another MessageType
  std::string comment;  ///< as in the definition
  std::string unit;     ///< "m/s^2", in brackets before the comment; empty: none, or given by name (_us) or type
  Form form = Form::Value;
  int size = 0;         ///< of a FixedArray
  std::string count;    ///< the field that holds the length of a List or Text (in UTF-8 bytes)
  bool digest = false;  ///< an int64_t that carries 64 unsigned bits; marked "[digest]" before the comment
};

/// One message type.
struct MessageType {
  std::string name;
  std::string comment;
  std::vector<MessageField> fields;
};

using MessageTypes = std::map<std::string, MessageType, std::less<>>;

/// The text of all lcmtypes/*.lcm, as of the build.
extern const char* const kDefinitions;

/// Parses definitions in the form that lcmtypes/ has: one field per line, followed by its comment. Other lines are
/// skipped.
MessageTypes parse_definitions(std::string_view text);

/// Returns the types of kDefinitions.
const MessageTypes& message_types();

}  // namespace tern::ros
