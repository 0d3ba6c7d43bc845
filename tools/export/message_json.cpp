#include "tools/export/message_json.h"

#include <fmt/format.h>

#include <bit>
#include <stdexcept>
#include <string>

namespace tern::exporting {
namespace {

constexpr std::size_t kFingerprintBytes = 8;

/// Big-endian values, one after the other.
class WireReader {
 public:
  explicit WireReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::span<const std::uint8_t> take(std::size_t n) {
    if (n > rest_.size()) throw std::out_of_range("a message ends before its fields do");
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }
  std::uint64_t unsigned_integer(std::size_t n) {
    std::uint64_t x = 0;
    for (const std::uint8_t byte : take(n)) x = x << 8U | byte;
    return x;
  }

 private:
  std::span<const std::uint8_t> rest_;
};

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
  return object_of(message_types().at(type), wire);
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
  const auto found = message_types().find(type);
  if (found == message_types().end()) throw std::out_of_range("no message type " + std::string(type));
  WireReader wire(bytes);
  wire.take(kFingerprintBytes);
  return object_of(found->second, wire);
}

}  // namespace tern::exporting
