// The wall clock while the system's is set. In a program of its own: clock_gettime is replaced, as if somebody set it,
// and so that time stands still until a test moves it.
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <lcm/lcm-cpp.hpp>

#include "messages/codec.h"
#include "runtime/lcm_network.h"
#include "runtime/wall_runner.h"

namespace {
constexpr std::int64_t kSecondNs = 1'000'000'000;
std::atomic<time_t> set_forward_s = 0;
std::atomic<std::int64_t> stands_at_ns = -1;  ///< what the steady clock shows while time stands still; −1: it goes on
}  // namespace

extern "C" int clock_gettime(clockid_t id, timespec* t) noexcept {
  const int status = static_cast<int>(syscall(SYS_clock_gettime, id, t));
  if (stands_at_ns >= 0 && (id == CLOCK_MONOTONIC || id == CLOCK_REALTIME)) {
    // The system's clock shows a day of 2026, µs since 1970.
    const std::int64_t ns = stands_at_ns + (id == CLOCK_REALTIME ? 1'790'000'000 * kSecondNs : 0);
    *t = {ns / kSecondNs, ns % kSecondNs};
  }
  if (id == CLOCK_REALTIME) t->tv_sec += set_forward_s;
  return status;
}

namespace tern {
namespace {

constexpr std::int64_t kSecond = 1'000'000;

std::int64_t system_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Steps every millisecond, twenty times; after the tenth somebody sets the system's clock back by an hour.
class TwentySteps final : public Node {
 public:
  explicit TwentySteps(Bus& bus) : next_(bus.clock().now()) {}
  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  void step(UTime now) override {
    next_ = now + Duration{1'000};
    if (++steps_ == 10) set_forward_s -= 3'600;
  }
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Waiting, "twenty steps"}; }
  [[nodiscard]] std::optional<int> finished() const override { return steps_ == 20 ? std::optional(7) : std::nullopt; }

 private:
  UTime next_;
  int steps_ = 0;
};

class WallClockTest : public testing::Test {
 protected:
  ~WallClockTest() override { set_forward_s = 0; }

  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  WallClock clock_;
  Bus bus_{lcm_, clock_, 1};
};

/// Time stands still, from before the clock is made until its end.
class StandingTimeTest : public testing::Test {
 protected:
  StandingTimeTest() { stands_at_ns = kSecondNs; }
  ~StandingTimeTest() override {
    set_forward_s = 0;
    stands_at_ns = -1;
  }
};

TEST_F(StandingTimeTest, GoesOnWhenTheSystemsClockIsSet) {
  const WallClock clock;
  for (const time_t seconds : {-3'600, 7'200}) {
    const UTime before = clock.now();
    set_forward_s += seconds;
    EXPECT_EQ(clock.now().us, before.us);
    stands_at_ns += kSecondNs;
    EXPECT_EQ((clock.now() - before).us, kSecond);
    EXPECT_EQ(clock.drift().us, set_forward_s * kSecond);
  }
}

TEST_F(StandingTimeTest, IsKnownOfAMessageAlthoughTheKernelSaysItByTheSystemsClock) {
  const WallClock clock;
  for (const time_t seconds : {0, -3'600, 3'600}) {
    set_forward_s = seconds;
    const UTime received = clock.at_system_time(system_us());
    EXPECT_EQ(received.us, clock.now().us) << seconds;
    stands_at_ns += kSecondNs;
    EXPECT_EQ((clock.now() - received).us, kSecond) << seconds;
  }
}

TEST_F(StandingTimeTest, AtAPaceAllClocksAgreeAndTakeTheirTime) {
  const WallClock slow({}, 0.25), other({}, 0.25);
  const std::int64_t begin_us = system_us();
  const UTime begin = slow.now();
  EXPECT_EQ(other.now().us, begin.us);
  EXPECT_EQ((slow.at_system_time(begin_us + 4 * kSecond) - begin).us, kSecond);
  EXPECT_EQ(slow.in_system_time(Duration{kSecond}).us, 4 * kSecond);
  EXPECT_EQ(WallClock::system_time_us(begin, 0.25), begin_us);
  EXPECT_EQ(WallClock::system_time_us(begin, 1.0), begin.us);
  stands_at_ns += kSecondNs;
  EXPECT_EQ((slow.now() - begin).us, kSecond / 4);
  EXPECT_EQ(system_us() - begin_us, kSecond);
  set_forward_s = 8;
  EXPECT_EQ(slow.drift().us, 8 * kSecond);
  EXPECT_EQ((slow.now() - begin).us, kSecond / 4) << "setting the system's clock does not set it";
}

TEST_F(WallClockTest, ANodeDoesNotStandStillWhenTheSystemsClockIsSetBack) {
  TwentySteps node(bus_);
  NodeHost host(bus_, node, "tern-stepper", "");
  EXPECT_EQ(run_on_wall_clock(*lcm_, host, -1), 7);
}

TEST_F(WallClockTest, AHeartbeatSaysThatTheSystemsClockWasSet) {
  std::vector<std::string> said;
  bus_.subscribe(channels::kHeartbeat, [&](const Heartbeat& h) { said.push_back(h.waiting_for); });
  TwentySteps node(bus_);
  for (const time_t seconds : {0, -5}) {
    set_forward_s = seconds;
    NodeHost(bus_, node, "tern-stepper", "").step(clock_.now());
  }
  drain(*lcm_, 100);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0], "twenty steps");
  EXPECT_NE(said[1].find("twenty steps; the system's clock was set back by "), std::string::npos) << said[1];
}

}  // namespace
}  // namespace tern
