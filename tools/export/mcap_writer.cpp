#include "tools/export/mcap_writer.h"

#include <zstd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace tern::exporting {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::string_view kCompression = "zstd";
/// Level 12 would save 0.2 % more.
constexpr int kCompressionLevel = 9;
/// A window of 8 MB, the largest that every decoder must have (RFC 8878 §3.1.1.1.2): it spans a chunk, and saves 6 %.
constexpr int kWindowLog = 23;

enum class Op : std::uint8_t {
  Header = 0x01,
  Footer = 0x02,
  Schema = 0x03,
  Channel = 0x04,
  Message = 0x05,
  Chunk = 0x06,
  MessageIndex = 0x07,
  ChunkIndex = 0x08,
  Statistics = 0x0B,
  SummaryOffset = 0x0E,
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

std::uint32_t crc_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::string compressed(std::string_view bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_windowLog, kWindowLog);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size) != 0) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

}  // namespace

McapWriter::McapWriter(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  write(kMagic);
  write(record(Op::Header, Fields{}.text("ros2").text("tern-export")));
}

void McapWriter::write(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  crc_.process_bytes(bytes.data(), bytes.size());
  size_ += bytes.size();
}

void McapWriter::Span::take(std::uint64_t ns) {
  first_ns = messages == 0 ? ns : std::min(first_ns, ns);
  last_ns = std::max(last_ns, ns);
  ++messages;
}

void McapWriter::add(const std::string& topic, const ros::RosType& type, std::int64_t time_us, std::string_view cdr) {
  const auto [known_schema, schema_is_new] =
      schemas_.try_emplace(type.name(), static_cast<std::uint16_t>(schemas_.size() + 1));
  if (schema_is_new) {
    const Fields fields =
        Fields{}.integer(known_schema->second).text(type.name()).text("ros2msg").text(type.definition());
    chunk_.records += record(Op::Schema, fields);
    schema_records_ += record(Op::Schema, fields);
  }
  const auto [known, is_new] =
      topics_.try_emplace(topic, Topic{static_cast<std::uint16_t>(topics_.size() + 1), type.name()});
  if (is_new) {
    const Fields fields =
        Fields{}.integer(known->second.id).integer(known_schema->second).text(topic).text("cdr").text("");
    chunk_.records += record(Op::Channel, fields);
    channel_records_ += record(Op::Channel, fields);
  }
  const std::uint64_t ns = static_cast<std::uint64_t>(time_us) * 1000;
  span_.take(ns);
  chunk_.span.take(ns);
  chunk_.index[known->second.id].emplace_back(ns, chunk_.records.size());
  Fields fields;
  fields.integer(known->second.id).integer(++known->second.messages).integer(ns).integer(ns);
  fields.bytes += cdr;
  chunk_.records += record(Op::Message, fields);
  if (chunk_.records.size() > kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_.span.messages == 0) return;
  const std::uint64_t start = size_, bytes = chunk_.records.size();
  Fields fields;
  fields.integer(chunk_.span.first_ns).integer(chunk_.span.last_ns).integer(bytes).integer(crc_of(chunk_.records));
  const std::string packed = compressed(chunk_.records);
  fields.text(kCompression).integer(std::uint64_t{packed.size()});
  fields.bytes += packed;
  write(record(Op::Chunk, fields));
  const std::uint64_t length = size_ - start;

  Fields where;  // each channel's index
  for (const auto& [channel, messages] : chunk_.index) {
    Fields entries;
    for (const auto& [ns, offset] : messages) entries.integer(ns).integer(offset);
    where.integer(channel).integer(size_);
    write(record(Op::MessageIndex, Fields{}.integer(channel).text(entries.bytes)));
  }
  Fields index;
  index.integer(chunk_.span.first_ns).integer(chunk_.span.last_ns).integer(start).integer(length).text(where.bytes);
  index.integer(size_ - start - length).text(kCompression).integer(std::uint64_t{packed.size()}).integer(bytes);
  chunk_index_records_ += record(Op::ChunkIndex, index);
  ++chunks_;
  chunk_ = {};
}

std::string McapWriter::statistics() const {
  Fields counts;
  for (const auto& [name, topic] : topics_) counts.integer(topic.id).integer(std::uint64_t{topic.messages});
  Fields fields;
  fields.integer(span_.messages).integer(static_cast<std::uint16_t>(schemas_.size()));
  fields.integer(static_cast<std::uint32_t>(topics_.size()));
  fields.integer(std::uint32_t{0}).integer(std::uint32_t{0}).integer(chunks_);  // attachments, metadata
  fields.integer(span_.first_ns).integer(span_.last_ns).text(counts.bytes);
  return record(Op::Statistics, fields);
}

Result<void> McapWriter::finish() {
  end_chunk();
  write(record(Op::DataEnd, Fields{}.integer(crc_.checksum())));
  crc_.reset();
  const std::uint64_t summary_start = size_;
  std::string offsets;
  const auto write_group = [&](Op op, const std::string& records) {
    if (records.empty()) return;
    const std::uint64_t start = size_;
    write(records);
    offsets += record(Op::SummaryOffset,
                      Fields{}.integer(static_cast<std::uint8_t>(op)).integer(start).integer(size_ - start));
  };
  write_group(Op::Schema, schema_records_);
  write_group(Op::Channel, channel_records_);
  write_group(Op::Statistics, statistics());
  write_group(Op::ChunkIndex, chunk_index_records_);
  const std::uint64_t offsets_start = size_;
  write(offsets);

  // The summary's checksum covers the footer up to itself.
  const std::string footer =
      record(Op::Footer, Fields{}.integer(summary_start).integer(offsets_start).integer(std::uint32_t{0}));
  write(std::string_view(footer).substr(0, footer.size() - sizeof(std::uint32_t)));
  write(Fields{}.integer(crc_.checksum()).bytes);
  write(kMagic);
  file_.close();
  if (!file_) return fail(path_ + ": cannot be written");
  return {};
}

}  // namespace tern::exporting
