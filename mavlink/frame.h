// MAVLink frames: bytes ↔ messages, checksums, signatures. https://mavlink.io/en/guide/serialization.html
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

/// Sender or receiver. 0: everyone.
struct Address {
  std::uint8_t system = 0, component = 0;
  friend auto operator<=>(const Address&, const Address&) = default;
};

/// A message on the wire. The payload has the full length of its type with all extensions; truncated bytes are zero.
struct Frame {
  Address from;
  std::uint8_t sequence = 0;
  std::uint32_t id = 0;
  Bytes payload;
};

/// Checksum seed and lengths of a message, per id.
struct MessageForm {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t min_length = 0;  ///< without extensions: the length in MAVLink 1
  std::uint8_t length = 0;      ///< with extensions
};
/// Returns the form of a message, or nullopt if messages.h does not contain it.
std::optional<MessageForm> form_of(std::uint32_t id);

/// CRC-16/MCRF4XX: reflected polynomial 0x8408, initial value `crc`, no final xor.
std::uint16_t crc16(std::span<const std::uint8_t> bytes, std::uint16_t crc = 0xFFFF);

/// A SHA-256 function. It is passed in, so that this library needs no cryptography.
using Sha256 = std::function<std::array<std::uint8_t, 32>(std::span<const std::uint8_t>)>;

/// A shared secret and the id of this end's link. A valid signature proves that the sender knows the secret and that
/// the frame is new.
struct SigningKey {
  std::array<std::uint8_t, 32> secret{};
  std::uint8_t link = 0;
  Sha256 sha256;
};
/// Converts µs since the Unix epoch to a signature's time: units of 10 µs since 2015-01-01.
std::uint64_t signature_time(std::int64_t utime_us);

/// Encodes a MAVLink 2 frame. Trailing zeros of the payload are cut, down to one byte.
/// @param time  of the signature; must ascend strictly per key
/// @pre the id is known and the payload has the length of its form  @throws std::invalid_argument otherwise
Bytes to_bytes(const Frame& frame, const SigningKey* key = nullptr, std::uint64_t time = 0);

/// Counts what a parser found.
struct ParserCounters {
  std::int64_t frames = 0;     ///< returned frames
  std::int64_t unknown = 0;    ///< frames of messages that messages.h does not contain: skipped by their length
  std::int64_t bad = 0;        ///< wrong checksum, length or flags: the search continues one byte later
  std::int64_t garbage = 0;    ///< bytes between frames
  std::int64_t unsigned_ = 0;  ///< with a key: unsigned, wrongly signed, or not newer than the last frame
};

/// Finds MAVLink 1 and 2 frames in a stream of bytes. Any bytes may arrive, in any portions. Memory stays below two
/// frames and one portion.
///
/// With a key, a frame is returned if it is signed by the key and newer than the last frame of its sender and link. The
/// first frame of a sender must be at most one minute older than `time`.
class Parser {
 public:
  explicit Parser(std::optional<SigningKey> key = {}) : key_(std::move(key)) {}
  /// Returns the frames that `bytes` completes. @param time  signature_time of now
  std::vector<Frame> push(std::span<const std::uint8_t> bytes, std::uint64_t time = 0);
  /// Drops an incomplete frame at the end of a datagram.
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
