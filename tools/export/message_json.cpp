#include "tools/export/message_json.h"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>
#include <string>

#include "ros_messages/message_types.h"
#include "ros_messages/wire_reader.h"

namespace tern::exporting {
namespace {

using ros::MessageField;
using ros::MessageType;
using ros::WireReader;

Json object_of(const MessageType& type, WireReader& wire);

Json value_of(const MessageField& field, WireReader& wire) {
  const std::string& type = field.type;
  if (type == "double") return std::bit_cast<double>(wire.unsigned_integer(8));
  if (type == "float") return std::bit_cast<float>(static_cast<std::uint32_t>(wire.unsigned_integer(4)));
  if (type == "int64_t") {
    const std::uint64_t x = wire.unsigned_integer(8);
    return field.digest ? Json(fmt::format("{:#018x}", x)) : Json(static_cast<std::int64_t>(x));
  }
  if (type == "int32_t") return static_cast<std::int32_t>(wire.unsigned_integer(4));
  if (type == "int16_t") return static_cast<std::int16_t>(wire.unsigned_integer(2));
  if (type == "int8_t") return static_cast<std::int8_t>(wire.unsigned_integer(1));
  if (type == "byte") return static_cast<std::uint8_t>(wire.unsigned_integer(1));
  if (type == "boolean") return wire.unsigned_integer(1) != 0;
  return object_of(ros::message_types().at(type), wire);
}

Json field_json(const MessageField& field, const Json& before, WireReader& wire) {
  if (field.form == MessageField::Form::Value) return value_of(field, wire);
  const auto size = field.form == MessageField::Form::FixedArray ? static_cast<std::size_t>(field.size)
                                                                 : before.at(field.count).get<std::size_t>();
  if (field.form == MessageField::Form::Text) {
    const auto bytes = wire.take(size);
    return std::string(bytes.begin(), bytes.end());
  }
  Json list = Json::array();
  for (std::size_t k = 0; k < size; ++k) list.push_back(value_of(field, wire));
  return list;
}

Json object_of(const MessageType& type, WireReader& wire) {
  Json object = Json::object();
  for (const MessageField& field : type.fields) object[field.name] = field_json(field, object, wire);
  return object;
}

}  // namespace

Json message_json(std::string_view type, std::span<const std::uint8_t> bytes) {
  const auto found = ros::message_types().find(type);
  if (found == ros::message_types().end()) throw std::out_of_range("no message type " + std::string(type));
  WireReader wire(bytes);
  return object_of(found->second, wire);
}

}  // namespace tern::exporting
