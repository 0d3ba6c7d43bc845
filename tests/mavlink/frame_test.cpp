#include "mavlink/frame.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "core/base/random.h"
#include "mavlink/messages.h"
#include "runtime/mac.h"
#include "tests/support/effort.h"

namespace tern::mavlink {
namespace {

Bytes from_hex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t k = 0; k + 1 < hex.size(); k += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(k, 2), nullptr, 16)));
  }
  return bytes;
}

/// Each element of each field, as make_frames.mjs prints it.
template <class T>
void append(std::vector<std::string>& values, const T& field) {
  if constexpr (std::is_same_v<T, char>) {
    values.push_back(std::to_string(static_cast<unsigned char>(field)));
  } else if constexpr (std::is_floating_point_v<T>) {
    std::ostringstream text;
    text.precision(17);
    text << field;
    values.push_back(text.str());
  } else if constexpr (std::is_integral_v<T>) {
    values.push_back(std::to_string(field));
  } else {
    for (const auto& element : field) append(values, element);
  }
}

struct Recorded {
  std::optional<SigningKey> key;
  std::uint64_t time = 0;
  Bytes bytes;
  std::vector<std::string> values;
};

std::vector<Recorded> recorded() {
  std::vector<Recorded> all;
  std::ifstream in(TERN_NODE_FRAMES);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Recorded r;
    std::string key, hex;
    int link = 0;
    words >> key >> link >> r.time >> hex;
    if (key != "0") {
      r.key.emplace();
      const Bytes secret = from_hex(key);
      std::copy(secret.begin(), secret.end(), r.key->secret.begin());
      r.key->link = static_cast<std::uint8_t>(link);
      r.key->sha256 = tern::sha256;
    }
    r.bytes = from_hex(hex);
    for (std::string value; words >> value;) r.values.push_back(value);
    all.push_back(std::move(r));
  }
  return all;
}

template <class... M>
void check(const Recorded& r, const Frame& frame, std::type_identity<std::tuple<M...>>) {
  int kinds = 0;
  const auto check_one = [&]<class T>(std::type_identity<T>) {
    const auto message = from_frame<T>(frame);
    if (!message) return;
    ++kinds;
    std::vector<std::string> values;
    std::apply([&](const auto&... field) { (append(values, field), ...); }, T::fields(*message));
    EXPECT_EQ(values, r.values) << T::kId;
    const Frame again = to_frame(*message, frame.from, frame.sequence);
    EXPECT_EQ(to_bytes(again, r.key ? &*r.key : nullptr, r.time), r.bytes) << T::kId;
  };
  (check_one(std::type_identity<M>{}), ...);
  EXPECT_EQ(kinds, 1);
}

TEST(Frame, MeansAndIsWhatNodeMavlinkSaysByteForByte) {
  const auto all = recorded();
  ASSERT_GT(all.size(), 60u);
  for (const Recorded& r : all) {
    Parser parser(r.key);
    const auto frames = parser.push(r.bytes, r.time);
    ASSERT_EQ(frames.size(), 1u);
    check(r, frames.front(), std::type_identity<AllMessages>{});
  }
}

TEST(Frame, ComesOutOfAnyPortionsAndBetweenGarbage) {
  const auto all = recorded();
  Bytes stream;
  std::size_t unsigned_frames = 0;
  for (const Recorded& r : all) {
    const Bytes garbage{0x00, 0xFD, 0x03, 0xFE, 0xFF};
    stream.insert(stream.end(), garbage.begin(), garbage.end());
    stream.insert(stream.end(), r.bytes.begin(), r.bytes.end());
    ++unsigned_frames;
  }
  stream.resize(stream.size() + 600, 0);  // garbage that looks like a frame's head claims at most this many bytes
  for (const std::size_t portion : {std::size_t{1}, std::size_t{7}, std::size_t{1000}}) {
    Parser parser;
    std::size_t found = 0;
    for (std::size_t k = 0; k < stream.size(); k += portion) {
      found += parser.push(std::span(stream).subspan(k, std::min(portion, stream.size() - k))).size();
    }
    EXPECT_EQ(found, unsigned_frames) << portion;
  }
}

TEST(Frame, OfMavlinkOneIsRead) {
  // HEARTBEAT by the first version's rules: no incompat flags, one byte of id, no cut.
  Bytes bytes{0xFE, 9, 7, 1, 1, 0, 4, 3, 2, 1, 2, 12, 81, 4, 3};
  const std::uint8_t extra = Heartbeat::kCrcExtra;
  const std::uint16_t crc = crc16({&extra, 1}, crc16(std::span(bytes).subspan(1)));
  bytes.push_back(static_cast<std::uint8_t>(crc));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  const auto frames = Parser().push(bytes);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(from_frame<Heartbeat>(frames[0])->custom_mode, 0x01020304u);
}

TEST(Frame, WithAFlagThatIsNotUnderstoodIsDropped) {
  Bytes bytes = recorded().front().bytes;
  bytes[2] |= 0x02;
  Parser parser;
  EXPECT_TRUE(parser.push(bytes).empty());
  EXPECT_GT(parser.counters().bad, 0);
}

TEST(Frame, SignedOnceIsHeardOnce) {
  for (const Recorded& r : recorded()) {
    if (!r.key) continue;
    Parser parser(r.key);
    EXPECT_EQ(parser.push(r.bytes, r.time).size(), 1u);
    EXPECT_EQ(parser.push(r.bytes, r.time).size(), 0u) << "a frame played again";
    Bytes forged = r.bytes;
    forged.back() ^= 1U;
    EXPECT_EQ(Parser(r.key).push(forged, r.time).size(), 0u);
    EXPECT_EQ(Parser(r.key).push(r.bytes, r.time + 7'000'000).size(), 0u) << "an old record";
    SigningKey other = *r.key;
    other.secret[0] ^= 1U;
    EXPECT_EQ(Parser(other).push(r.bytes, r.time).size(), 0u);
  }
}

TEST(Frame, UnsignedIsNotHeardByWhoHasAKey) {
  SigningKey key;
  key.sha256 = tern::sha256;
  Parser parser(key);
  const auto all = recorded();
  EXPECT_TRUE(parser.push(all.front().bytes).empty());
  EXPECT_EQ(parser.counters().unsigned_, 1);
}

/// Mutated streams: no crash, and each returned frame encodes to bytes of the stream.
TEST(Frame, HostileBytesAreSkippedOrMeanWhatTheySay) {
  Rng rng(7);
  const auto all = recorded();
  const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n)); };
  const int count = support::at_effort(20'000);
  Parser parser;
  for (int k = 0; k < count; ++k) {
    Bytes bytes = all[pick(all.size())].bytes;
    const std::size_t changes = pick(4);
    for (std::size_t c = 0; c < changes; ++c) bytes[pick(bytes.size())] = static_cast<std::uint8_t>(pick(256));
    if (rng.uniform() < 0.2) bytes.resize(pick(bytes.size() + 1));
    for (const Frame& frame : parser.push(bytes)) {
      ASSERT_TRUE(form_of(frame.id));
      ASSERT_EQ(frame.payload.size(), form_of(frame.id)->length);
      ASSERT_FALSE(to_bytes(frame).empty());
    }
  }
  EXPECT_GT(parser.counters().frames, count / 8);
  EXPECT_GT(parser.counters().bad, count / 8);
}

TEST(Frame, RandomBytesAreNoFrames) {
  Rng rng(8);
  Parser parser;
  for (int k = 0; k < 2'000; ++k) {
    Bytes bytes(100);
    for (auto& b : bytes) b = rng.uniform() < 0.1 ? 0xFD : static_cast<std::uint8_t>(rng.uniform() * 256.0);
    parser.push(bytes);
  }
  EXPECT_LE(parser.counters().frames, 2);
}

TEST(Text, IsReadUpToItsEndAndIsPrintable) {
  EXPECT_EQ(string_of(text_of<16>("COM_OF_LOSS_T")), "COM_OF_LOSS_T");
  EXPECT_EQ(string_of(text_of<4>("too long")), "too ");
  EXPECT_EQ(string_of(Text<4>{'a', '\n', '\x80', 'b'}), "a??b");
}

}  // namespace
}  // namespace tern::mavlink
