// The wall clock while the system's is set. In a program of its own: clock_gettime is replaced, as if somebody set it.
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
std::atomic<time_t> set_forward_s = 0;
}

extern "C" int clock_gettime(clockid_t id, timespec* t) noexcept {
  const int status = static_cast<int>(syscall(SYS_clock_gettime, id, t));
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

TEST_F(WallClockTest, GoesOnWhenTheSystemsClockIsSet) {
  for (const time_t seconds : {-3'600, 7'200}) {
    const UTime before = clock_.now();
    set_forward_s += seconds;
    EXPECT_GE(clock_.now(), before);
    EXPECT_LT((clock_.now() - before).us, 600 * kSecond);
    EXPECT_NEAR(clock_.drift().seconds(), static_cast<double>(set_forward_s), 0.01);
  }
}

TEST_F(WallClockTest, KnowsWhenAMessageCameAlthoughTheKernelSaysItByTheSystemsClock) {
  for (const time_t seconds : {0, -3'600, 3'600}) {
    set_forward_s = seconds;
    const UTime earliest = clock_.now();
    const UTime received = clock_.at_system_time(system_us());
    EXPECT_GE((received - earliest).seconds(), -0.01) << seconds;
    EXPECT_LE((received - clock_.now()).seconds(), 0.01) << seconds;
  }
}

TEST_F(WallClockTest, AtAPaceAllClocksAgreeAndTakeTheirTime) {
  const WallClock slow({}, 0.25), other({}, 0.25);
  const std::int64_t begin_us = system_us();
  const UTime begin = slow.now();
  EXPECT_NEAR((other.now() - slow.now()).seconds(), 0.0, 0.01);
  EXPECT_NEAR((slow.at_system_time(begin_us + 4 * kSecond) - begin).seconds(), 1.0, 0.01);
  EXPECT_EQ(slow.in_system_time(Duration{kSecond}).us, 4 * kSecond);
  EXPECT_NEAR(1e-6 * static_cast<double>(WallClock::system_time_us(begin, 0.25) - begin_us), 0.0, 0.01);
  EXPECT_EQ(WallClock::system_time_us(begin, 1.0), begin.us);
  while (slow.now() - begin < Duration{20'000}) continue;
  EXPECT_GE(system_us() - begin_us, 79'000);
  set_forward_s = 8;
  EXPECT_NEAR(slow.drift().seconds(), 8.0, 0.01);
  EXPECT_LT((slow.now() - begin).seconds(), 600.0) << "setting the system's clock does not set it";
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
