#include "mavlink/frame.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "mavlink/messages.h"

namespace tern::mavlink {
namespace {

constexpr std::uint8_t kMagic1 = 0xFE, kMagic2 = 0xFD, kSignedFlag = 0x01;
constexpr std::size_t kHead1 = 6, kHead2 = 10, kCrc = 2, kSignature = 13, kShortTag = 6;
/// Largest number of remembered signers: more than one link carries.
constexpr std::size_t kMaxSigners = 64;
constexpr std::uint64_t kMinute = 6'000'000;

std::uint64_t read_time(std::span<const std::uint8_t> six) {
  std::uint64_t time = 0;
  for (std::size_t k = 6; k-- > 0;) time = (time << 8U) | six[k];
  return time;
}

std::array<std::uint8_t, kShortTag> tag_of(const SigningKey& key, std::span<const std::uint8_t> signed_bytes) {
  Bytes all(key.secret.begin(), key.secret.end());
  all.insert(all.end(), signed_bytes.begin(), signed_bytes.end());
  const auto digest = key.sha256(all);
  std::array<std::uint8_t, kShortTag> tag{};
  std::copy_n(digest.begin(), kShortTag, tag.begin());
  return tag;
}

void append_signature(Bytes& bytes, const SigningKey& key, std::uint64_t time) {
  bytes.push_back(key.link);
  for (int k = 0; k < 6; ++k) bytes.push_back(static_cast<std::uint8_t>(time >> (8 * k)));
  const auto tag = tag_of(key, bytes);
  bytes.insert(bytes.end(), tag.begin(), tag.end());
}

std::uint16_t checksum(std::span<const std::uint8_t> head_and_payload, std::uint8_t extra) {
  return crc16({&extra, 1}, crc16(head_and_payload));
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes, std::uint16_t crc) {
  for (const std::uint8_t byte : bytes) {
    auto x = static_cast<std::uint8_t>(byte ^ (crc & 0xFFU));
    x = static_cast<std::uint8_t>(x ^ (x << 4U));
    crc = static_cast<std::uint16_t>((crc >> 8U) ^ (x << 8U) ^ (x << 3U) ^ (x >> 4U));
  }
  return crc;
}

std::uint64_t signature_time(std::int64_t utime_us) {
  constexpr std::int64_t kEpoch2015 = 1'420'070'400'000'000;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(utime_us - kEpoch2015, 0) / 10);
}

Bytes to_bytes(const Frame& frame, const SigningKey* key, std::uint64_t time) {
  const auto form = form_of(frame.id);
  if (!form || frame.payload.size() != form->length) {
    throw std::invalid_argument("message " + std::to_string(frame.id) + " of " + std::to_string(frame.payload.size()) +
                                " bytes");
  }
  std::size_t length = frame.payload.size();
  while (length > 1 && frame.payload[length - 1] == 0) --length;
  const std::array<std::uint8_t, kHead2> head{kMagic2,
                                              static_cast<std::uint8_t>(length),
                                              key != nullptr ? kSignedFlag : std::uint8_t{0},
                                              0,
                                              frame.sequence,
                                              frame.from.system,
                                              frame.from.component,
                                              static_cast<std::uint8_t>(frame.id),
                                              static_cast<std::uint8_t>(frame.id >> 8U),
                                              static_cast<std::uint8_t>(frame.id >> 16U)};
  Bytes bytes(kHead2 + length);
  std::copy(head.begin(), head.end(), bytes.begin());
  std::copy_n(frame.payload.begin(), length, bytes.begin() + kHead2);
  const std::uint16_t crc = checksum(std::span(bytes).subspan(1), form->crc_extra);
  bytes.push_back(static_cast<std::uint8_t>(crc));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  if (key != nullptr) append_signature(bytes, *key, time);
  return bytes;
}

bool Parser::verified(std::span<const std::uint8_t> frame, Address from, std::uint64_t time) {
  if (!key_) return true;
  if (frame[0] != kMagic2 || (frame[2] & kSignedFlag) == 0) return false;
  const auto tag = tag_of(*key_, frame.first(frame.size() - kShortTag));
  if (!std::equal(tag.begin(), tag.end(), frame.end() - kShortTag)) return false;
  const std::uint8_t link = frame[frame.size() - kSignature];
  const std::uint64_t time_stated = read_time(frame.subspan(frame.size() - kSignature + 1, 6));
  const auto known = std::ranges::find_if(signers_, [&](const Signer& s) { return s.from == from && s.link == link; });
  if (known == signers_.end()) {
    if (time_stated + kMinute < time || signers_.size() >= kMaxSigners) return false;
    signers_.push_back({from, link, time_stated});
    return true;
  }
  if (time_stated <= known->time) return false;
  known->time = time_stated;
  return true;
}

Parser::Outcome Parser::read_frame(std::span<const std::uint8_t> bytes, std::uint64_t time, std::vector<Frame>& frames,
                                   std::size_t& used) {
  const bool second = bytes[0] == kMagic2;
  const std::size_t head = second ? kHead2 : kHead1;
  if (bytes.size() < head) return Outcome::More;
  const std::size_t length = bytes[1];
  if (second && (bytes[2] & ~kSignedFlag) != 0) return Outcome::Bad;
  const bool is_signed = second && (bytes[2] & kSignedFlag) != 0;
  used = head + length + kCrc + (is_signed ? kSignature : 0);
  if (bytes.size() < used) return Outcome::More;

  Frame frame;
  const std::size_t at = second ? 4 : 2;
  frame.sequence = bytes[at];
  frame.from = {bytes[at + 1], bytes[at + 2]};
  frame.id = bytes[at + 3];
  if (second) frame.id |= static_cast<std::uint32_t>(bytes[8]) << 8U | static_cast<std::uint32_t>(bytes[9]) << 16U;
  const auto form = form_of(frame.id);
  if (!form) {
    ++counters_.unknown;
    return Outcome::Skipped;
  }
  if (!second && length != form->min_length) return Outcome::Bad;
  const std::uint16_t crc = checksum(bytes.subspan(1, head - 1 + length), form->crc_extra);
  if (bytes[head + length] != (crc & 0xFFU) || bytes[head + length + 1] != crc >> 8U) return Outcome::Bad;
  if (!verified(bytes.first(used), frame.from, time)) {
    ++counters_.unsigned_;
    return Outcome::Skipped;
  }
  const auto payload = bytes.subspan(head, length);
  frame.payload.assign(payload.begin(), payload.end());
  frame.payload.resize(form->length, 0);  // extensions of newer versions are cut
  frames.push_back(std::move(frame));
  ++counters_.frames;
  return Outcome::Frame;
}

std::vector<Frame> Parser::push(std::span<const std::uint8_t> bytes, std::uint64_t time) {
  rest_.insert(rest_.end(), bytes.begin(), bytes.end());
  std::vector<Frame> frames;
  std::size_t at = 0;
  while (at < rest_.size()) {
    if (rest_[at] != kMagic1 && rest_[at] != kMagic2) {
      ++at;
      ++counters_.garbage;
      continue;
    }
    std::size_t used = 0;
    const Outcome found = read_frame(std::span(rest_).subspan(at), time, frames, used);
    if (found == Outcome::More) break;
    if (found == Outcome::Bad) ++counters_.bad;
    at += found == Outcome::Bad ? 1 : used;
  }
  rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(at));
  return frames;
}

void Parser::drop_rest() {
  counters_.garbage += static_cast<std::int64_t>(rest_.size());
  rest_.clear();
}

}  // namespace tern::mavlink
