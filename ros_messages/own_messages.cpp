#include "ros_messages/own_messages.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "ros_messages/message_types.h"
#include "ros_messages/wire_reader.h"

namespace tern::ros {
namespace {

using Form = MessageField::Form;

/// "search_view_t" → "tern_msgs/msg/SearchView".
std::string own_name(std::string_view lcm_type) {
  std::string name = "tern_msgs/msg/";
  bool starts_word = true;
  for (const char c : lcm_type.substr(0, lcm_type.size() - 2)) {
    if (c != '_') name += starts_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    starts_word = c == '_';
  }
  return name;
}

std::string primitive_of(const MessageField& field) {
  if (field.form == Form::Text) return "string";
  if (field.digest) return "uint64";
  static const std::map<std::string, std::string, std::less<>> kPrimitives = {
      {"double", "float64"}, {"float", "float32"}, {"int64_t", "int64"}, {"int32_t", "int32"},
      {"int16_t", "int16"},  {"int8_t", "int8"},   {"byte", "uint8"},    {"boolean", "bool"}};
  return kPrimitives.at(field.type);
}

void describe(std::vector<TypeDescription>& types, std::set<std::string>& known, const MessageType& type) {
  if (!known.insert(type.name).second) return;
  const std::size_t place = types.size();
  types.push_back({own_name(type.name), {}});
  for (const MessageField& field : type.fields) {
    FieldDescription described;
    described.name = field.name;
    described.comment = field.comment;
    if (field.form == Form::List) described.form = FieldDescription::Form::Sequence;
    if (field.form == Form::FixedArray) described.form = FieldDescription::Form::Array;
    described.size = static_cast<std::size_t>(field.size);
    const auto nested = message_types().find(field.type);
    described.type = nested == message_types().end() ? primitive_of(field) : own_name(field.type);
    types[place].fields.push_back(std::move(described));
    if (nested != message_types().end()) describe(types, known, nested->second);
  }
}

/// Reads fields in LCM's encoding and writes them as CDR.
class Transcoder {
 public:
  explicit Transcoder(std::span<const std::uint8_t> bytes) : wire_(bytes) {}

  void object(const MessageType& type) {
    std::map<std::string_view, std::size_t> lengths;
    for (const MessageField& field : type.fields) {
      switch (field.form) {
        case Form::Value: {
          const std::uint64_t integer = value(field);
          if (field.type == "int32_t") lengths[field.name] = integer;
          break;
        }
        case Form::FixedArray: elements(field, static_cast<std::size_t>(field.size)); break;
        case Form::Text: text(lengths.at(field.count)); break;
        case Form::List:
          cdr_.write(static_cast<std::uint32_t>(lengths.at(field.count)));
          elements(field, lengths.at(field.count));
          break;
      }
    }
  }
  std::string take() { return cdr_.take(); }

 private:
  void elements(const MessageField& field, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) value(field);
  }

  void text(std::size_t size) {
    const auto bytes = wire_.take(size);
    cdr_.write(std::string(bytes.begin(), bytes.end()));
  }

  /// Returns an integer's bits; 0 for other values.
  std::uint64_t value(const MessageField& field) {
    const std::string& type = field.type;
    if (type == "double") {
      cdr_.write(std::bit_cast<double>(wire_.unsigned_integer(8)));
    } else if (type == "float") {
      cdr_.write(std::bit_cast<float>(static_cast<std::uint32_t>(wire_.unsigned_integer(4))));
    } else if (type == "int64_t") {
      return integer<std::uint64_t>();
    } else if (type == "int32_t") {
      return integer<std::uint32_t>();
    } else if (type == "int16_t") {
      return integer<std::uint16_t>();
    } else if (type == "int8_t" || type == "byte" || type == "boolean") {
      return integer<std::uint8_t>();
    } else {
      object(message_types().at(type));
    }
    return 0;
  }

  template <class Unsigned>
  std::uint64_t integer() {
    const std::uint64_t bits = wire_.unsigned_integer(sizeof(Unsigned));
    cdr_.write(static_cast<Unsigned>(bits));
    return bits;
  }

  WireReader wire_;
  CdrWriter cdr_;
};

}  // namespace

const RosType& own_type(std::string_view lcm_type) {
  static const auto kTypes = [] {
    std::map<std::string, RosType, std::less<>> types;
    for (const auto& [name, type] : message_types()) {
      std::set<std::string> known;
      describe(types[name].types, known, type);
    }
    return types;
  }();
  const auto found = kTypes.find(lcm_type);
  if (found == kTypes.end()) throw std::out_of_range("no message type " + std::string(lcm_type));
  return found->second;
}

std::string own_cdr(std::string_view lcm_type, std::span<const std::uint8_t> bytes) {
  const auto found = message_types().find(lcm_type);
  if (found == message_types().end()) throw std::out_of_range("no message type " + std::string(lcm_type));
  Transcoder transcoder(bytes);
  transcoder.object(found->second);
  return transcoder.take();
}

}  // namespace tern::ros
