#include "tools/export/mcap_writer.h"

#include <algorithm>

namespace tern::exporting {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";

enum class Op : std::uint8_t {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Statistics = 0x0B,
  DataEnd = 0x0F,
};

/// Little-endian fields, one after the other.
struct Fields {
  std::string bytes;

  template <class Integer>
  Fields& integer(Integer x) {
    for (std::size_t k = 0; k < sizeof x; ++k) bytes += static_cast<char>(static_cast<std::uint64_t>(x) >> (8 * k));
    return *this;
  }
  Fields& text(std::string_view t) {
    integer(static_cast<std::uint32_t>(t.size()));
    bytes += t;
    return *this;
  }
};

std::string record(Op op, const Fields& fields) {
  Fields whole;
  whole.integer(static_cast<std::uint8_t>(op)).integer(static_cast<std::uint64_t>(fields.bytes.size()));
  return whole.bytes + fields.bytes;
}

}  // namespace

McapWriter::McapWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  write(kMagic);
  write(record(Op::Header, Fields{}.text("").text("tern-export")));
}

void McapWriter::write(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  size_ += bytes.size();
}

void McapWriter::add(const std::string& topic, const std::string& schema_name, Json (*schema)(const std::string& name),
                     std::int64_t time_us, const Json& message) {
  const auto [known_schema, schema_is_new] =
      schemas_.try_emplace(schema_name, static_cast<std::uint16_t>(schemas_.size() + 1));
  const std::size_t before = summary_.size();
  if (schema_is_new) {
    summary_ += record(
        Op::Schema,
        Fields{}.integer(known_schema->second).text(schema_name).text("jsonschema").text(schema(schema_name).dump()));
  }
  const auto [known, is_new] = topics_.try_emplace(topic, Topic{static_cast<std::uint16_t>(topics_.size())});
  if (is_new) {
    summary_ +=
        record(Op::Channel,
               Fields{}.integer(known->second.id).integer(known_schema->second).text(topic).text("json").text(""));
  }
  write(std::string_view(summary_).substr(before));

  const std::uint64_t ns = static_cast<std::uint64_t>(time_us) * 1000;
  first_ns_ = messages_ == 0 ? ns : std::min(first_ns_, ns);
  last_ns_ = std::max(last_ns_, ns);
  ++messages_;
  Fields fields;
  fields.integer(known->second.id).integer(++known->second.messages).integer(ns).integer(ns);
  fields.bytes += message.dump();
  write(record(Op::Message, fields));
}

std::string McapWriter::statistics() const {
  Fields counts;
  for (const auto& [name, topic] : topics_) counts.integer(topic.id).integer(std::uint64_t{topic.messages});
  Fields fields;
  fields.integer(messages_).integer(static_cast<std::uint16_t>(schemas_.size()));
  fields.integer(static_cast<std::uint32_t>(topics_.size()));
  for (int none = 0; none < 3; ++none) fields.integer(std::uint32_t{0});  // attachments, metadata, chunks
  fields.integer(first_ns_).integer(last_ns_).text(counts.bytes);
  return record(Op::Statistics, fields);
}

Result<void> McapWriter::finish() {
  write(record(Op::DataEnd, Fields{}.integer(std::uint32_t{0})));
  const std::uint64_t summary_start = size_;
  write(summary_);
  write(statistics());
  write(record(Op::Footer, Fields{}.integer(summary_start).integer(std::uint64_t{0}).integer(std::uint32_t{0})));
  write(kMagic);
  file_.close();
  if (!file_) return fail(path_ + ": cannot be written");
  return {};
}

}  // namespace tern::exporting
