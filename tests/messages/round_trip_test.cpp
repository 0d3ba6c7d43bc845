#include <gtest/gtest.h>

#include "messages/wire.h"
#include "tests/messages/messages_under_test.h"
#include "tests/support/generators.h"

namespace tern {
namespace {

template <class T>
class RoundTrip : public testing::Test {};
TYPED_TEST_SUITE(RoundTrip, AllMessages);

TYPED_TEST(RoundTrip, KeepsEveryFieldOfRandomValues) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const auto value = support::random_message<TypeParam>(rng);
    const auto decoded = decode<TypeParam>(encode(value));
    ASSERT_TRUE(decoded) << "draw " << i << ": rejection " << static_cast<int>(decoded.error());
    ASSERT_EQ(words_of(*decoded), words_of(value)) << "draw " << i;
  }
}

TYPED_TEST(RoundTrip, KeepsTheLargestMessageAndStaysUnderTheLimit) {
  Rng rng(2);
  const auto value = support::random_message<TypeParam>(rng, support::Fill::Largest);
  const Bytes bytes = encode(value);
  EXPECT_LE(bytes.size(), static_cast<std::size_t>(kMaxMessageBytes));
  const auto decoded = decode<TypeParam>(bytes);
  ASSERT_TRUE(decoded) << "rejection " << static_cast<int>(decoded.error());
  EXPECT_EQ(words_of(*decoded), words_of(value));
}

TYPED_TEST(RoundTrip, PutsCountsRightBehindTheFingerprint) {
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const auto value = support::random_message<TypeParam>(rng);
    const Bytes bytes = encode(value);
    std::size_t offset = wire::kFingerprintBytes;
    for (const std::int32_t size : array_sizes(value)) {
      EXPECT_EQ(wire::read_integer<std::int32_t>(bytes, offset), size);
      offset += wire::kCountBytes;
    }
  }
}

}  // namespace
}  // namespace tern
