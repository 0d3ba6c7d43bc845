#include "tests/tools/export/mcap_file.h"

#include <zstd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <tuple>

namespace tern::testing {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

void expect(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error("MCAP: " + what);
}

/// CRC-32 of IEEE 802.3, a bit at a time.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

std::string unpacked(std::string_view packed, std::uint64_t size) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 26U;
  expect(size <= kMost, "a chunk's size");
  std::string bytes(size, '\0');
  expect(ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size()) == size, "a chunk's size");
  return bytes;
}

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] std::size_t at() const { return at_; }
  std::string_view take(std::uint64_t n) {
    expect(n <= bytes_.size() - at_, "a length beyond the end");
    at_ += n;
    return bytes_.substr(at_ - n, n);
  }
  template <class Integer>
  Integer integer() {
    std::uint64_t x = 0;
    const std::string_view bytes = take(sizeof(Integer));
    for (std::size_t k = 0; k < sizeof(Integer); ++k)
      x |= std::uint64_t{static_cast<std::uint8_t>(bytes[k])} << (8 * k);
    return static_cast<Integer>(x);
  }
  std::uint16_t u16() { return integer<std::uint16_t>(); }
  std::uint32_t u32() { return integer<std::uint32_t>(); }
  std::uint64_t u64() { return integer<std::uint64_t>(); }
  std::string_view text() { return take(u32()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

struct Record {
  int op = 0;
  std::string_view body;
  std::size_t start = 0, end = 0;  ///< of the whole record in its bytes
};

std::vector<Record> records_of(std::string_view bytes, std::size_t offset) {
  std::vector<Record> records;
  for (Cursor cursor(bytes); !cursor.at_end();) {
    Record record;
    record.start = offset + cursor.at();
    record.op = cursor.integer<std::uint8_t>();
    record.body = cursor.take(cursor.u64());
    record.end = offset + cursor.at();
    records.push_back(record);
  }
  return records;
}

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}

  McapFile read() {
    const std::string_view all = bytes_;
    expect(all.starts_with(kMagic) && all.ends_with(kMagic) && all.size() >= 16, "the magic");
    const auto records = records_of(all.substr(8, all.size() - 16), 8);
    expect(!records.empty() && records.front().op == 0x01, "a Header first");
    expect(Cursor(records.front().body).text() == "ros2", "the profile");
    expect(records.back().op == 0x02, "a Footer last");
    for (const Record& record : records) take(record);
    check_footer(records.back());
    expect(indexed_chunks_ == file_.chunks, "a ChunkIndex for each Chunk");
    return std::move(file_);
  }

 private:
  using Index = std::map<std::tuple<std::uint16_t, std::uint64_t, std::uint64_t>, int>;  // channel, time, offset

  void take(const Record& record) {
    switch (record.op) {
      case 0x03: return take_schema(record.body);
      case 0x04: return take_channel(record.body);
      case 0x06: return take_chunk(record);
      case 0x07: return take_message_index(record);
      case 0x08: return take_chunk_index(record.body);
      case 0x0B: return take_statistics(record.body);
      case 0x0E: return take_summary_offset(record.body);
      case 0x0F:
        expect(indexed_ == placed_, "the last chunk's index names its messages");
        data_ended_ = true;
        return expect(Cursor(record.body).u32() == crc32(std::string_view(bytes_).substr(0, record.start)),
                      "the data's checksum");
      default: return expect(record.op == 0x01 || record.op == 0x02, "record " + std::to_string(record.op));
    }
  }

  void take_schema(std::string_view body) {
    Cursor cursor(body);
    const std::uint16_t id = cursor.u16();
    expect(id != 0, "a schema's id is not 0");
    const std::string name(cursor.text());
    expect(cursor.text() == "ros2msg", "the schema's encoding");
    const std::string schema(cursor.text());
    expect(schema_names_.try_emplace(id, name).first->second == name, "one name per schema");
    expect(file_.schemas.try_emplace(name, schema).first->second == schema, "the same schema whenever it is told");
  }

  void take_channel(std::string_view body) {
    Cursor cursor(body);
    const std::uint16_t id = cursor.u16();
    const std::string schema = schema_names_.at(cursor.u16());
    const std::string topic(cursor.text());
    expect(cursor.text() == "cdr", "the messages' encoding");
    const auto known = channels_.try_emplace(id, topic, schema).first->second;
    expect(known == std::pair(topic, schema), "the same channel whenever it is told");
  }

  void take_chunk(const Record& chunk) {
    expect(!data_ended_, "no chunk behind DataEnd");
    expect(indexed_ == placed_, "the index behind a chunk names its messages");
    indexed_.clear();
    placed_.clear();
    Cursor cursor(chunk.body);
    const std::uint64_t first_ns = cursor.u64(), last_ns = cursor.u64(), size = cursor.u64();
    const std::uint32_t crc = cursor.u32();
    expect(cursor.text() == "zstd", "the compression");
    const std::string records = unpacked(cursor.take(cursor.u64()), size);
    expect(cursor.at_end(), "nothing behind the records");
    expect(crc32(records) == crc, "a chunk's checksum");
    const std::size_t before = file_.messages.size();
    for (const Record& record : records_of(records, 0)) {
      if (record.op == 0x05) {
        take_message(record);
      } else {
        expect(record.op == 0x03 || record.op == 0x04, "a chunk holds schemas, channels, messages");
        take(record);
      }
    }
    std::uint64_t least = UINT64_MAX, most = 0;
    for (std::size_t k = before; k < file_.messages.size(); ++k) {
      least = std::min(least, file_.messages[k].log_ns);
      most = std::max(most, file_.messages[k].log_ns);
    }
    expect(least == first_ns && most == last_ns, "a chunk's times");
    chunks_[chunk.start] = chunk.end - chunk.start;
    ++file_.chunks;
  }

  void take_message(const Record& record) {
    Cursor cursor(record.body);
    const std::uint16_t channel = cursor.u16();
    McapMessage message;
    std::tie(message.topic, message.schema) = channels_.at(channel);
    message.sequence = cursor.u32();
    message.log_ns = cursor.u64();
    expect(cursor.u64() == message.log_ns, "the time of publishing");
    const std::string_view cdr = record.body.substr(cursor.at());
    message.cdr.assign(cdr.begin(), cdr.end());
    ++placed_[{channel, message.log_ns, record.start}];
    file_.messages.push_back(std::move(message));
  }

  void take_message_index(const Record& record) {
    Cursor cursor(record.body);
    const std::uint16_t channel = cursor.u16();
    for (Cursor entries(cursor.text()); !entries.at_end();) {
      const std::uint64_t ns = entries.u64(), offset = entries.u64();
      ++indexed_[{channel, ns, offset}];
    }
    message_indexes_[record.start] = channel;
  }

  void take_chunk_index(std::string_view body) {
    Cursor cursor(body);
    expect(cursor.u64() <= cursor.u64(), "a ChunkIndex's times");
    const std::uint64_t start = cursor.u64(), length = cursor.u64();
    expect(chunks_.contains(start) && chunks_.at(start) == length, "a ChunkIndex points to its Chunk");
    for (Cursor where(cursor.text()); !where.at_end();) {
      const std::uint16_t channel = where.u16();
      const std::uint64_t offset = where.u64();
      expect(message_indexes_.contains(offset) && message_indexes_.at(offset) == channel,
             "a ChunkIndex points to the MessageIndexes");
    }
    ++indexed_chunks_;
  }

  void take_statistics(std::string_view body) {
    Cursor cursor(body);
    expect(cursor.u64() == file_.messages.size(), "the number of messages");
    expect(cursor.u16() == file_.schemas.size(), "the number of schemas");
    expect(cursor.u32() == channels_.size(), "the number of channels");
    expect(cursor.u32() == 0 && cursor.u32() == 0, "neither attachments nor metadata");
    expect(cursor.u32() == static_cast<std::uint32_t>(file_.chunks), "the number of chunks");
    file_.first_ns = cursor.u64();
    file_.last_ns = cursor.u64();
    for (Cursor counts(cursor.text()); !counts.at_end();) {
      const std::string& topic = channels_.at(counts.u16()).first;
      file_.counted[topic] = counts.u64();
    }
  }

  void take_summary_offset(std::string_view body) {
    Cursor cursor(body);
    const int op = cursor.integer<std::uint8_t>();
    const std::uint64_t start = cursor.u64(), length = cursor.u64();
    const auto group = records_of(std::string_view(bytes_).substr(start, length), start);
    expect(!group.empty(), "a group of the summary");
    for (const Record& record : group) expect(record.op == op, "a group of the summary is of one kind");
  }

  void check_footer(const Record& footer) {
    Cursor cursor(footer.body);
    const std::uint64_t summary = cursor.u64(), offsets = cursor.u64();
    expect(summary > 0 && summary < offsets && offsets < footer.start, "where the summary is");
    const std::string_view summed = std::string_view(bytes_).substr(summary, footer.end - 4 - summary);
    expect(cursor.u32() == crc32(summed), "the summary's checksum");
  }

  std::string bytes_;
  McapFile file_;
  bool data_ended_ = false;
  int indexed_chunks_ = 0;
  std::map<std::uint16_t, std::string> schema_names_;
  std::map<std::uint16_t, std::pair<std::string, std::string>> channels_;  ///< topic, schema
  std::map<std::uint64_t, std::uint64_t> chunks_;                          ///< start, length
  std::map<std::uint64_t, std::uint16_t> message_indexes_;                 ///< start, channel
  Index placed_, indexed_;                                                 ///< of the newest chunk
};

}  // namespace

McapFile parse_mcap(std::string bytes) { return Reader(std::move(bytes)).read(); }

McapFile read_mcap(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return parse_mcap({std::istreambuf_iterator<char>(file), {}});
}

}  // namespace tern::testing
