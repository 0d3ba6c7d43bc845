// MAVLink's frames: bytes ↔ messages, checksums, signatures. https://mavlink.io/en/guide/serialization.html
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace tern::mavlink {

using Bytes = std::vector<std::uint8_t>;

/// Who sends, or who is meant. 0: everyone.
struct Address {
  std::uint8_t system = 0, component = 0;
  friend auto operator<=>(const Address&, const Address&) = default;
};

/// A message as it travels. The payload is as long as its type with all extensions, zeros where the sender cut them.
struct Frame {
  Address from;
  std::uint8_t sequence = 0;
  std::uint32_t id = 0;
  Bytes payload;
};

/// What a frame's checksum and length rest on, by message id.
struct MessageForm {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t min_length = 0;  ///< without extensions: of a MAVLink 1 frame
  std::uint8_t length = 0;      ///< with extensions
};
/// @return nullopt if the message is none of messages.h.
std::optional<MessageForm> form_of(std::uint32_t id);

/// CRC-16/MCRF4XX: reflected polynomial 0x8408, begun with `crc`, no final xor.
std::uint16_t crc16(std::span<const std::uint8_t> bytes, std::uint16_t crc = 0xFFFF);

/// SHA-256, by whoever has one.
using Sha256 = std::function<std::array<std::uint8_t, 32>(std::span<const std::uint8_t>)>;

/// A shared secret and this end's link. Signatures prove that the sender knows the secret, and that a frame is new.
struct SigningKey {
  std::array<std::uint8_t, 32> secret{};
  std::uint8_t link = 0;
  Sha256 sha256;
};
/// Microseconds since the Unix epoch as a signature's time: units of 10 µs since 2015-01-01.
std::uint64_t signature_time(std::int64_t utime_us);

/// A MAVLink 2 frame: trailing zeros of the payload cut, one byte left. @param time  of the signature; strictly
/// ascending per key. @pre the id is known, the payload as long as its form  @throws std::invalid_argument otherwise
Bytes to_bytes(const Frame& frame, const SigningKey* key = nullptr, std::uint64_t time = 0);

/// What a parser met.
struct ParserCounters {
  std::int64_t frames = 0;     ///< handed over
  std::int64_t unknown = 0;    ///< of messages that are none of ours: skipped by their length
  std::int64_t bad = 0;        ///< checksum, length or flags wrong: the search goes on one byte later
  std::int64_t garbage = 0;    ///< bytes between frames
  std::int64_t unsigned_ = 0;  ///< a key is needed: unsigned, wrongly signed, or not newer than the last
};

/// Finds frames in a stream of bytes (MAVLink 1 and 2). Any bytes may come, in any portions; memory stays below two
/// frames and a portion. With a key only frames signed by it are handed over, each newer than the last of its sender
/// and link. A sender's first one is at most a minute older than `time`.
class Parser {
 public:
  explicit Parser(std::optional<SigningKey> key = {}) : key_(std::move(key)) {}
  /// @param time  signature_time of now
  std::vector<Frame> push(std::span<const std::uint8_t> bytes, std::uint64_t time = 0);
  /// A datagram ends: what is incomplete will not be completed.
  void drop_rest();
  [[nodiscard]] const ParserCounters& counters() const { return counters_; }

 private:
  enum class Outcome : std::uint8_t { Frame, Skipped, Bad, More };
  Outcome read_frame(std::span<const std::uint8_t> bytes, std::uint64_t time, std::vector<Frame>& frames,
                     std::size_t& used);
  bool verified(std::span<const std::uint8_t> frame, Address from, std::uint64_t time);
  struct Signer {
    Address from;
    std::uint8_t link = 0;
    std::uint64_t time = 0;
  };
  std::optional<SigningKey> key_;
  Bytes rest_;
  ParserCounters counters_;
  std::vector<Signer> signers_;
};

}  // namespace tern::mavlink
