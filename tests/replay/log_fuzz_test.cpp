// Ten thousand ways to damage a recorded log: no reader may crash or allocate without bound.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "core/base/random.h"
#include "flight_log/flight_log.h"
#include "messages/codec.h"
#include "tests/messages/allocation_meter.h"
#include "tests/support/effort.h"
#include "tests/support/random_splines.h"

namespace tern {
namespace {

using support::random_integer;

const int kMutations = support::at_effort(10'000);
constexpr std::size_t kMostHeld = std::size_t{64} << 20U;  // bytes
constexpr std::size_t kLogBytes = 20'000;                  ///< of the log: every kind of message occurs

std::size_t place_in(const std::string& log, Rng& rng) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(log.size()));
}

/// Returns where an event's head begins: damage to its lengths is the most harmful.
std::size_t head_in(const std::string& log, Rng& rng) {
  const std::size_t found = log.find("\xED\xA1\xDA\x01", place_in(log, rng));
  return found == std::string::npos ? 0 : found;
}

void damage(std::string& log, Rng& rng) {
  const std::size_t at = place_in(log, rng);
  const std::size_t length = std::min<std::size_t>(1 + place_in(log, rng) % 300, log.size() - at);
  switch (random_integer(rng, 0, 6)) {
    case 0: log[at] = static_cast<char>(random_integer(rng, 0, 255)); break;
    case 1: log.resize(at); break;
    case 2: log.erase(at, length); break;
    case 3: log.insert(at, log, place_in(log, rng), length); break;
    case 4:
      std::generate_n(log.begin() + static_cast<std::ptrdiff_t>(at), length,
                      [&] { return static_cast<char>(random_integer(rng, 0, 255)); });
      break;
    default: {  ///< a length, a number or a time of a head
      const std::size_t field = head_in(log, rng) + 4 + static_cast<std::size_t>(random_integer(rng, 0, 23));
      if (field < log.size()) log[field] = static_cast<char>(rng.uniform() < 0.5 ? 0x7F : random_integer(rng, 0, 255));
    }
  }
}

/// A file in memory.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create("log", MFD_CLOEXEC)) {}
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  void hold(const std::string& bytes) const {
    ASSERT_EQ(ftruncate(fd_, static_cast<off_t>(bytes.size())), 0);
    ASSERT_EQ(pwrite(fd_, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

TEST(LogFuzz, MutationsNeitherCrashNorTakeMemory) {
  std::ifstream file(TERN_GOLDEN_LOG, std::ios::binary);
  std::string whole((std::istreambuf_iterator<char>(file)), {});
  ASSERT_GT(whole.size(), kLogBytes);
  whole.resize(kLogBytes);
  const MemoryFile memory;
  std::int64_t messages = 0;
  FlightLog log;
  for_each_channel([&]<class T>(const Channel<T>& channel) {
    log.on(channel, [&messages](const T&, std::int64_t) { ++messages; });
  });
  Rng rng(1);
  for (int k = 0; k < kMutations; ++k) {
    std::string damaged = whole;
    for (int n = random_integer(rng, 1, 3); n > 0 && !damaged.empty(); --n) damage(damaged, rng);
    memory.hold(damaged);
    const AllocationMeter meter;
    const auto contents = log.read(memory.path());
    ASSERT_TRUE(contents) << k;
    ASSERT_LT(meter.peak(), kMostHeld) << k;
    ASSERT_LE(contents->damage.bytes, static_cast<std::int64_t>(damaged.size())) << k;
  }
  EXPECT_GT(messages, kMutations * 20) << "most of each log is still read";
}

}  // namespace
}  // namespace tern
