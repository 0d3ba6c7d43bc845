#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "messages/refused_field.h"
#include "messages/wire.h"
#include "tests/messages/allocation_meter.h"
#include "tests/messages/messages_under_test.h"
#include "tests/support/effort.h"
#include "tests/support/generators.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_integer;

const int kMutants = support::at_effort(100'000);
/// A message of 60 kB is held twice, as generated type and as value, in vectors that may have doubled their capacity.
constexpr std::size_t kMostAllocated = 512 * 1024;

template <class Integer>
void write_integer(Bytes& bytes, std::size_t offset, Integer value) {
  auto x = static_cast<std::uint64_t>(value);
  for (std::size_t i = sizeof(Integer); i-- > 0; x >>= 8U) bytes[offset + i] = static_cast<std::uint8_t>(x);
}

std::size_t random_index(Rng& rng, std::size_t size) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(size));
}

std::uint8_t random_byte(Rng& rng) { return static_cast<std::uint8_t>(random_integer(rng, 0, 255)); }

void flip_bits(Rng& rng, Bytes& bytes) {
  const int flips = random_integer(rng, 1, 4);
  for (int i = 0; i < flips; ++i)
    bytes[random_index(rng, bytes.size())] ^= static_cast<std::uint8_t>(1U << random_index(rng, 8));
}

void truncate(Rng& rng, Bytes& bytes) { bytes.resize(random_index(rng, bytes.size())); }

void extend(Rng& rng, Bytes& bytes) {
  const int more = random_integer(rng, 1, 200);
  for (int i = 0; i < more; ++i) bytes.push_back(random_byte(rng));
}

/// Replaces a count (or the bytes at its place, if the type has none) by a hostile one.
void set_count(Rng& rng, Bytes& bytes, std::size_t counts) {
  static constexpr std::int32_t kHostile[] = {0x40000001,
                                              -1,
                                              std::numeric_limits<std::int32_t>::min(),
                                              std::numeric_limits<std::int32_t>::max(),
                                              0x10000,
                                              0x20000000,
                                              0,
                                              1,
                                              7};
  const std::size_t offset =
      wire::kFingerprintBytes + wire::kCountBytes * random_index(rng, std::max<std::size_t>(1, counts));
  if (offset + wire::kCountBytes > bytes.size()) return;
  write_integer<std::int32_t>(bytes, offset, kHostile[random_index(rng, std::size(kHostile))]);
}

/// Changes one count slightly and gives the message the matching length: the form is right, the content is shifted.
void slip(Rng& rng, Bytes& bytes, std::size_t counts) {
  if (counts == 0) return flip_bits(rng, bytes);
  const std::size_t offset = wire::kFingerprintBytes + wire::kCountBytes * random_index(rng, counts);
  const int by = random_integer(rng, -2, 2);
  write_integer<std::int32_t>(bytes, offset, wire::read_integer<std::int32_t>(bytes, offset) + by);
  static constexpr int kElementBytes[] = {1, 4, 6, 13, 24, 36, 44, 53, 80, 81, 92, 128};
  const int element = kElementBytes[random_index(rng, std::size(kElementBytes))];
  const auto size = static_cast<std::ptrdiff_t>(bytes.size()) + by * element;
  bytes.resize(static_cast<std::size_t>(std::max<std::ptrdiff_t>(size, 0)), random_byte(rng));
}

/// Replaces eight bytes by a harmful number.
void set_number(Rng& rng, Bytes& bytes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kNumbers[] = {
      std::numeric_limits<double>::quiet_NaN(),  kInfinity, -kInfinity, 1e308, -1e308, -0.0, 0.0,
      std::numeric_limits<double>::denorm_min(), 1e7,       -1.0};
  static constexpr std::int64_t kIntegers[] = {std::numeric_limits<std::int64_t>::min(),
                                               std::numeric_limits<std::int64_t>::max(), -1, std::int64_t{1} << 40U};
  if (bytes.size() < 16) return;
  const std::size_t offset = random_index(rng, bytes.size() - 7);
  if (rng.uniform() < 0.5) {
    write_integer(bytes, offset, std::bit_cast<std::int64_t>(kNumbers[random_index(rng, std::size(kNumbers))]));
  } else {
    write_integer(bytes, offset, kIntegers[random_index(rng, std::size(kIntegers))]);
  }
}

/// Joins the head of one message and the tail of another.
void splice(Rng& rng, Bytes& bytes, const Bytes& other) {
  const std::size_t cut = random_index(rng, std::min(bytes.size(), other.size()));
  bytes.resize(cut);
  bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(cut), other.end());
}

void mutate(Rng& rng, Bytes& bytes, const Bytes& other, std::size_t counts) {
  switch (random_integer(rng, 0, 6)) {
    case 0: return flip_bits(rng, bytes);
    case 1: return truncate(rng, bytes);
    case 2: return extend(rng, bytes);
    case 3: return set_count(rng, bytes, counts);
    case 4: return slip(rng, bytes, counts);
    case 5: return set_number(rng, bytes);
    default: return splice(rng, bytes, other);
  }
}

template <class T>
class HostileBytes : public testing::Test {};
TYPED_TEST_SUITE(HostileBytes, AllMessages);

/// Bytes that decode() accepts are the encoding of the value: no number is clamped, repaired or ignored. Detections at
/// no place are left out and counted.
TYPED_TEST(HostileBytes, AreRefusedOrMeanWhatTheySayAndAllocateLittle) {
  Rng rng(4);
  std::vector<Bytes> originals;
  for (int i = 0; i < 200; ++i) originals.push_back(encode(support::random_message<TypeParam>(rng)));
  const std::size_t counts = array_sizes(support::random_message<TypeParam>(rng)).size();
  std::size_t largest = 0;
  std::size_t peak = 0;
  int accepted = 0;
  for (int i = 0; i < kMutants; ++i) {
    Bytes bytes = originals[random_index(rng, originals.size())];
    mutate(rng, bytes, originals[random_index(rng, originals.size())], counts);
    const AllocationMeter meter;
    const auto decoded = decode<TypeParam>(bytes);
    largest = std::max(largest, meter.largest());
    peak = std::max(peak, meter.peak());
    if (!decoded) continue;
    ++accepted;
    if constexpr (std::is_same_v<TypeParam, ObservationSet>) {
      if (const std::int32_t left_out = left_out_elements<ObservationSet>(bytes); left_out > 0) {
        ASSERT_EQ(array_sizes(*decoded)[0] + left_out,
                  wire::read_integer<std::int32_t>(bytes, wire::kFingerprintBytes));
        continue;
      }
    }
    ASSERT_EQ(encode(*decoded), bytes) << "mutant " << i;
  }
  EXPECT_LE(largest, kMostAllocated);
  EXPECT_LE(peak, kMostAllocated);
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, kMutants);
  this->RecordProperty("accepted", accepted);
  this->RecordProperty("peak_bytes", static_cast<int>(peak));
}

TYPED_TEST(HostileBytes, OfNoMessageAreRefused) {
  Rng rng(5);
  for (int i = 0; i < 10'000; ++i) {
    Bytes bytes(random_index(rng, 300));
    for (std::uint8_t& byte : bytes) byte = random_byte(rng);
    EXPECT_FALSE(decode<TypeParam>(bytes));
  }
}

}  // namespace
}  // namespace tern
