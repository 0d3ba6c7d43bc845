// What lcmtypes/*.lcm say of the messages: the fields in the order of the wire, with units and comments.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tern::exporting {

/// A field of a message type.
struct MessageField {
  enum class Form { Value, FixedArray, List, Text };

  std::string name;
  std::string type;     ///< an LCM primitive, or the name of another MessageType
  std::string comment;  ///< as the definition has it
  std::string unit;     ///< "m/s^2", in brackets before the comment; empty: none, or the name (_us) or the type says it
  Form form = Form::Value;
  int size = 0;         ///< of a FixedArray
  std::string count;    ///< the field that counts a List or a Text (UTF-8 bytes)
  bool digest = false;  ///< an int64_t that carries 64 unsigned bits: "[digest]" before the comment
};

struct MessageType {
  std::string name;
  std::string comment;
  std::vector<MessageField> fields;
};

using MessageTypes = std::map<std::string, MessageType, std::less<>>;

/// lcmtypes/*.lcm, one after the other, as they were when this was built.
extern const char* const kDefinitions;

/// Reads definitions in the form that lcmtypes/ has: a field per line, its comment behind it. Lines of another form are
/// passed over.
MessageTypes parse_definitions(std::string_view text);

/// All of kDefinitions.
const MessageTypes& message_types();

}  // namespace tern::exporting
