#include "messages/form.h"
#include "tern_msgs/map_file_t.hpp"

namespace tern {

template <>
struct wire::Form<MapFile> {
  using Message = tern_msgs::map_file_t;
  static_assert(Message::MAX_BYTES == kMaxMapFileBytesPerMessage);
  static_assert(Message::MAX_PARTS == kMaxMapFileParts);
  static constexpr Layout kLayout{
      Array{&Message::byte_count, &Message::content, 0, kMaxMapFileBytesPerMessage},
  };

  static void fields(auto& io, auto& m, auto& file) {
    io.header("header", m.header, file.header);
    io.time("at_us", m.at_us, file.at);
    io.enumeration("format", m.format, file.format, MapFormat::OctoMap);
    io.position("origin", m.origin, file.origin);
    io.integer("part", m.part, file.part, 0, kMaxMapFileParts - 1);
    io.integer("parts", m.parts, file.parts, 1, kMaxMapFileParts);
    // Every byte is legal: the reader of the format judges them.
    io.list("content", m.content, file.bytes, [&io](auto& byte, auto& value) { io.any("byte", byte, value); });
  }

  static void read_rest(FieldReader& read, const Message& /*m*/, const MapFile& file) {
    read.consistent(file.part < file.parts);
  }
};

template Bytes encode(const MapFile& value);
template tl::expected<MapFile, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<MapFile>(std::span<const std::uint8_t> bytes);

}  // namespace tern
