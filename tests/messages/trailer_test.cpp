// The trailer of a sender with a key: decoders accept exactly one, and no other bytes after a message.
#include "messages/trailer.h"

#include <gtest/gtest.h>

#include "messages/codec.h"
#include "tests/messages/messages_under_test.h"
#include "tests/support/generators.h"

namespace tern {
namespace {

constexpr Trailer kTrailer{2, {1'000'000, 7}, UTime{2'000'000}, {}};

Bytes with_trailer(Bytes bytes, const Trailer& trailer = kTrailer) {
  append_trailer_head(bytes, trailer);
  bytes.insert(bytes.end(), trailer.tag.begin(), trailer.tag.end());
  return bytes;
}

Bytes message() {
  Goal goal;
  goal.id = 3;
  goal.header = {{1'000'000, 7}, UTime{2'000'000}};
  return encode(goal);
}

TEST(Trailer, ReadsAsItWasWritten) {
  Trailer written = kTrailer;
  for (std::size_t k = 0; k < kTagBytes; ++k) written.tag[k] = static_cast<std::uint8_t>(200 + k);
  const Bytes bytes = with_trailer({1, 2, 3}, written);
  EXPECT_EQ(bytes.size(), 3 + kTrailerBytes);
  const auto read = read_trailer(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->role, 2);
  EXPECT_EQ(read->name, written.name);
  EXPECT_EQ(read->utime, written.utime);
  EXPECT_EQ(read->tag, written.tag);
}

TEST(Trailer, IsPassedOverByTheDecoderAndItsTagIsNotRead) {
  const auto plain = decode<Goal>(message());
  const auto signed_one = decode<Goal>(with_trailer(message()));
  ASSERT_TRUE(plain && signed_one);
  EXPECT_EQ(signed_one->id, plain->id);
  EXPECT_EQ(signed_one->header.name, plain->header.name);
}

template <class T>
class SignedMessages : public testing::Test {};
TYPED_TEST_SUITE(SignedMessages, AllMessages);

TYPED_TEST(SignedMessages, ReadAsUnsignedOnesAlsoTheLargest) {
  Rng rng(7);
  for (const support::Fill fill : {support::Fill::Mixed, support::Fill::Largest}) {
    const auto value = support::random_message<TypeParam>(rng, fill);
    const auto read = decode<TypeParam>(with_trailer(encode(value)));
    ASSERT_TRUE(read);
    EXPECT_EQ(words_of(*read), words_of(value));
  }
}

TEST(Trailer, AnythingElseBehindAMessageIsAWrongLength) {
  const Bytes good = with_trailer(message());
  std::vector<Bytes> bad = {with_trailer(good)};  // two of them
  for (const std::size_t at : {0U, 4U, 6U, 7U}) {
    bad.push_back(good);
    bad.back()[message().size() + at] ^= 1U;  // magic, version, reserved bytes
  }
  for (std::size_t cut = 1; cut < kTrailerBytes; ++cut)
    bad.emplace_back(good.begin(), good.end() - static_cast<int>(cut));
  Bytes longer = message();
  longer.insert(longer.end(), kTrailerBytes, 0);
  bad.push_back(longer);
  for (const Bytes& bytes : bad) {
    const auto read = decode<Goal>(bytes);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error(), Rejection::Length);
  }
}

TEST(Trailer, IsNotReadOutOfShorterBytes) {
  for (std::size_t n = 0; n < kTrailerBytes; ++n) EXPECT_FALSE(read_trailer(Bytes(n, 'T')));
}

}  // namespace
}  // namespace tern
