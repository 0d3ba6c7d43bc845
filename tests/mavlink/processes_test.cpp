// tern-mavlink and tern-autopilot-sim as processes, with a relay between them that loses, doubles, reorders and cuts.
// Runs inside tests/support/hermetic.sh, which gives it a network of its own. The test plays the executor.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "core/base/random.h"
#include "mavlink/autopilot.h"
#include "mavlink/messages.h"
#include "tests/support/child_process.h"
#include "tests/support/network_end.h"

namespace tern::mavlink {
namespace {

using testing::HasSubstr;

/// A UDP socket of this host.
class Socket {
 public:
  Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = local(0);
    socklen_t length = sizeof(address);
    if (bind(fd_, reinterpret_cast<sockaddr*>(&address), length) != 0) throw std::runtime_error("bind");
    getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
  }
  ~Socket() { close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  static sockaddr_in local(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  void send(const Bytes& bytes, int to) const {
    const sockaddr_in address = local(to);
    sendto(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  std::optional<Bytes> receive() {
    Bytes bytes(2048);
    sockaddr_in from{};
    socklen_t length = sizeof(from);
    const ssize_t n = recvfrom(fd_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &length);
    if (n < 0) return std::nullopt;
    last_from = ntohs(from.sin_port);
    bytes.resize(static_cast<std::size_t>(n));
    return bytes;
  }
  [[nodiscard]] int port() const { return port_; }
  int last_from = 0;

 private:
  int fd_, port_ = 0;
};

/// Between the bridge's port and the autopilot.
struct Relay {
  Socket to_autopilot, to_bridge;
  int bridge_port = Socket().port(), autopilot_port = 0;
  double lost = 0.0, doubled = 0.0, swapped = 0.0;
  bool cut = false;
  Rng rng{1};
  std::optional<Odometry> vision;  ///< the newest one that the bridge sent

  void pump() {
    while (const auto bytes = to_autopilot.receive()) {
      autopilot_port = to_autopilot.last_from;
      pass(*bytes, held_down, [&](const Bytes& b) { to_bridge.send(b, bridge_port); });
    }
    while (const auto bytes = to_bridge.receive()) {
      for (const Frame& frame : Parser().push(*bytes)) {
        if (const auto told = from_frame<Odometry>(frame)) vision = told;
      }
      pass(*bytes, held_up, [&](const Bytes& b) { to_autopilot.send(b, autopilot_port); });
    }
  }

 private:
  template <class Send>
  void pass(const Bytes& bytes, std::deque<Bytes>& held, const Send& send) {
    if (cut || rng.uniform() < lost) return;
    if (rng.uniform() < swapped && held.size() < 4) {
      held.push_back(bytes);  // sent after the next one
      return;
    }
    send(bytes);
    if (rng.uniform() < doubled) send(bytes);
    for (const Bytes& late : held) send(late);
    held.clear();
  }
  std::deque<Bytes> held_down, held_up;
};

class MavlinkProcesses : public testing::Test, protected NetworkEnd {
 protected:
  MavlinkProcesses() {
    bus->subscribe(channels::kVehicleStatus, [this](const VehicleStatus& s) { status = s; });
    bus->subscribe(channels::kUavState, [this](const UavState& s) { state = s; });
    bus->subscribe(channels::kVehicleTruth, [this](const UavState& s) { truth = s; });
    start_autopilot();
  }

  void start_autopilot() {
    autopilot = std::make_unique<Child>(std::vector<std::string>{
        TERN_AUTOPILOT_SIM, "--connect", "udpout://127.0.0.1:" + std::to_string(relay.to_autopilot.port()), "--set",
        "autopilot_sim.busy_s=0.2"});
  }
  std::unique_ptr<Child> make_bridge(int port, std::vector<std::string> more = {}) {
    std::vector<std::string> words{TERN_MAVLINK, "--connect", "udp://127.0.0.1:" + std::to_string(port)};
    for (const char* value : {"mavlink.start=arm", "mavlink.set_parameters=true", "uav.dynamics.tilt_max=45",
                              "uav.limits.v_max=[6, 6, 1.5]", "mavlink.without_remote=true", "mavlink.climb_speed=3"}) {
      more.insert(more.begin(), {"--set", value});
    }
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Child>(words);
  }
  void start_bridge(std::vector<std::string> more = {}) { bridge = make_bridge(relay.bridge_port, std::move(more)); }

  /// One step of relay and bus. The executor's part, at 100 Hz: rest where the vehicle began to follow.
  void look() {
    relay.pump();
    pollfd fd{lcm->getFileno(), POLLIN, 0};
    poll(&fd, 1, 1);
    drain(*lcm, 1'000);
    bus->rethrow();
    const UTime now = clock.now();
    if (!state || now < next_setpoint || !speaks) return;
    next_setpoint = now + Duration{10'000};
    if (!status.following || !rest) rest = state->motion.p;
    UavState setpoint;
    setpoint.at = now;
    setpoint.motion.p = *rest;
    bus->publish(channels::kSetpoint, setpoint);
  }
  bool until(const std::function<bool()>& condition, int patience_ms = kPatienceMs) {
    const UTime end = clock.now() + Duration{patience_ms * 1'000LL};
    while (!condition() && clock.now() < end) look();
    return condition();
  }
  bool until_following() {
    return until([&] { return status.following; });
  }
  void run_ms(int ms) {
    until([] { return false; }, ms);
  }
  /// A command of a ground station on its own link.
  template <class M>
  void ground_station(const M& message) {
    Socket().send(to_bytes(to_frame(message, {255, 190}, 0)), relay.autopilot_port);
  }
  void say_goal(std::int64_t id) {
    Goal goal;
    goal.id = id;
    bus->publish(channels::kGoal, goal);
  }
  void expect_that_a_second_one_waits();
  void expect_that_a_killed_one_comes_back_or_stands_back();
  void set_parameter(const char* name, float value) {
    ground_station(ParamSet{.param_value = value, .target_system = 1, .param_id = text_of<16>(name), .param_type = 9});
  }

  Relay relay;
  std::unique_ptr<Child> autopilot, bridge;
  VehicleStatus status;
  std::optional<UavState> state, truth;
  std::optional<Vec3> rest;
  UTime next_setpoint;
  bool speaks = true;
};

const CommandLong kPilot{.param = {1, 3, 0}, .command = kDoSetMode, .target_system = 1};

/// A second bridge, at the port of the first and at another one, does not fly.
void MavlinkProcesses::expect_that_a_second_one_waits() {
  const std::int64_t first = status.header.name.sender_epoch_us;
  auto same_port = make_bridge(relay.bridge_port);
  ASSERT_TRUE(until([&] { return same_port->has_ended(); })) << "the first one's link and setpoints go on meanwhile";
  EXPECT_EQ(same_port->wait(), 2);
  EXPECT_THAT(same_port->output, HasSubstr("another bridge or ground station listens there"));
  auto second = make_bridge(Socket().port());
  EXPECT_TRUE(until([&] {
    return std::any_of(beats.begin(), beats.end(), [](const tern::Heartbeat& b) {
      return b.waiting_for.find("another process flies this vehicle") != std::string::npos;
    });
  }));
  EXPECT_TRUE(status.following);
  EXPECT_EQ(status.header.name.sender_epoch_us, first);
}

/// The bridge dies. By the failsafe's time, the vehicle is still in OFFBOARD or landing.
void MavlinkProcesses::expect_that_a_killed_one_comes_back_or_stands_back() {
  bridge->signal(SIGKILL);
  EXPECT_EQ(bridge->wait(), -SIGKILL);
  // Its last messages may still wait in this process's queue.
  const std::int64_t killed = status.header.name.sender_epoch_us;
  start_bridge();
  const auto is_back = [&] { return status.header.name.sender_epoch_us != killed; };
  ASSERT_TRUE(until([&] { return is_back() && (status.following || status.mode == "AUTO.LAND"); })) << status.why_not;
  if (status.mode == "AUTO.LAND") {
    run_ms(2000);
    EXPECT_FALSE(status.following);
    EXPECT_EQ(status.mode, "AUTO.LAND");
  }
}

/// One flight that shows much, since a take-off takes long.
TEST_F(MavlinkProcesses, TheOneOfTwoIsKilledComesBackAndLands) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  ASSERT_NO_FATAL_FAILURE(expect_that_a_second_one_waits());
  ASSERT_NO_FATAL_FAILURE(expect_that_a_killed_one_comes_back_or_stands_back());
  if (!status.following) {
    ASSERT_TRUE(until([&] { return !status.armed; })) << "its failsafe lands it";
  }
  bridge->signal(SIGTERM);
  EXPECT_TRUE(until([&] { return !status.armed; }));
  EXPECT_EQ(bridge->wait(), 0);
}

/// The companion's estimator sends to a port of the bridge's, by the system's clock.
TEST_F(MavlinkProcesses, PublishACompanionsOdometryAndSayWhatItLacks) {
  const Socket companion;
  const int port = Socket().port();
  std::optional<tern::Odometry> estimate;
  bus->subscribe(channels::kOdometry, [&](const tern::Odometry& odometry) { estimate = odometry; });
  start_bridge({"--odometry", "udp://127.0.0.1:" + std::to_string(port), "--set", "mavlink.odometry=companion"});
  Odometry m;
  m.q = {1, 0, 0, 0};
  m.frame_id = m.child_frame_id = 20;
  m.quality = 100;
  m.pose_covariance[0] = std::numeric_limits<float>::quiet_NaN();
  const auto say = [&] {
    m.time_usec = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count());
    companion.send(to_bytes(to_frame(m, {1, 197}, 0)), port);
  };
  EXPECT_TRUE(until([&] {
    say();
    return status.why_not.find("it does not state how wrong its position is") != std::string::npos;
  })) << status.why_not;
  EXPECT_FALSE(estimate);
  for (const std::size_t k : {0U, 6U, 11U, 15U, 18U, 20U}) m.pose_covariance[k] = 0.04F;
  for (const std::size_t k : {0U, 6U, 11U}) m.velocity_covariance[k] = 0.01F;
  EXPECT_TRUE(until([&] {
    say();
    return estimate.has_value();
  })) << status.why_not;
  EXPECT_NEAR(estimate->pose_covariance[0], 0.04, 1e-6);
  EXPECT_LT(clock.now() - estimate->at, Duration{1'000'000});
  EXPECT_TRUE(until([&] {
    say();
    return status.following || status.mode == "OFFBOARD";
  })) << status.why_not;
}

TEST_F(MavlinkProcesses, FlyAndLandWhenAskedToEnd) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  EXPECT_EQ(status.mode, "OFFBOARD");
  ASSERT_TRUE(truth);
  EXPECT_LT((truth->motion.p - Vec3(0, 0, 1)).norm(), 0.5) << "above uav.start";
  EXPECT_LT((truth->motion.p - state->motion.p).norm(), 0.2);
  bridge->signal(SIGTERM);
  EXPECT_TRUE(until([&] { return !status.armed; })) << "it stays until the vehicle stands";
  EXPECT_EQ(bridge->wait(), 0);
  EXPECT_THAT(bridge->output, HasSubstr("the autopilot has landed"));
  EXPECT_NEAR(truth->motion.p.z(), 0.0, 0.05);
}

TEST_F(MavlinkProcesses, OutliveAShortCutAndStandBackAfterALongOne) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  relay.cut = true;
  run_ms(200);
  relay.cut = false;
  run_ms(700);
  EXPECT_TRUE(status.following) << status.why_not;
  relay.cut = true;
  run_ms(1500);
  EXPECT_THAT(status.why_not, HasSubstr("no message from the autopilot"));
  relay.cut = false;
  ASSERT_TRUE(until([&] { return status.mode == "AUTO.LAND"; }));
  EXPECT_FALSE(status.following);
  EXPECT_TRUE(until([&] { return !status.armed; })) << "it has landed by its failsafe";
}

TEST_F(MavlinkProcesses, AfterACutOfFiveSecondsFindTheVehicleLandedAndLeaveItThere) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  say_goal(1);
  relay.cut = true;
  run_ms(5000);
  EXPECT_FALSE(status.following);
  EXPECT_THAT(status.why_not, HasSubstr("no message from the autopilot"));
  relay.cut = false;
  ASSERT_TRUE(until([&] { return !status.armed; })) << "its failsafe has landed it";
  run_ms(1500);
  EXPECT_FALSE(status.armed);
  EXPECT_THAT(status.why_not, HasSubstr("stood back"));
  say_goal(2);
  EXPECT_TRUE(until_following()) << status.why_not;
}

TEST_F(MavlinkProcesses, GiveWayToAPilotAndFlyAgainWhenTold) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  say_goal(1);
  run_ms(50);
  ground_station(kPilot);
  ASSERT_TRUE(until([&] { return !status.following; }));
  EXPECT_THAT(status.why_not, HasSubstr("has changed to POSCTL"));
  say_goal(1);
  run_ms(1500);
  EXPECT_EQ(status.mode, "POSCTL") << "a goal that is repeated is no new one";
  say_goal(2);
  EXPECT_TRUE(until_following()) << status.why_not;
}

TEST_F(MavlinkProcesses, SayWhyArmingIsRefused) {
  ASSERT_TRUE(until([&] { return relay.autopilot_port != 0; }));
  set_parameter("SIM_ARM_REFUSE", 1.0F);
  start_bridge();
  EXPECT_TRUE(until([&] { return status.why_not.find("Arming denied") != std::string::npos; })) << status.why_not;
  EXPECT_FALSE(status.armed);
}

TEST_F(MavlinkProcesses, TellJumpsAndLandWithALowBattery) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  set_parameter("SIM_EST_JUMP", 0.6F);
  EXPECT_TRUE(until([&] { return status.resets == 1; }));
  set_parameter("SIM_BAT_PCT", 10.0F);
  ASSERT_TRUE(until([&] { return status.mode == "AUTO.LAND"; })) << status.why_not;
  EXPECT_THAT(status.why_not, HasSubstr("battery 10 %"));
}

TEST_F(MavlinkProcesses, AKilledBridgeComesBackWithTheTruthThatItTold) {
  const std::vector<std::string> sees{"--set", "mavlink.external_vision=true"};
  start_bridge(sees);
  ASSERT_TRUE(until_following()) << status.why_not;
  set_parameter("SIM_EV_JUMP", 0.0F);
  bridge->signal(SIGKILL);
  EXPECT_EQ(bridge->wait(), -SIGKILL);
  truth.reset();
  relay.vision.reset();
  start_bridge(sees);
  ASSERT_TRUE(until([&] { return truth && relay.vision; })) << status.why_not;
  // The estimate is the truth here. Messages within 20 ms have the same place, even of a landing vehicle.
  for (int k = 0; k < 10; ++k) {
    run_ms(50);
    EXPECT_LT((truth->motion.p - state->motion.p).norm(), 0.1);
    EXPECT_NEAR(-relay.vision->p[2], state->motion.p.z(), 0.1);
  }
  EXPECT_GT(state->motion.p.z(), 0.2) << "or else this shows nothing";
}

TEST_F(MavlinkProcesses, FlyOverALinkThatLosesDoublesAndReorders) {
  relay.lost = 0.2;
  relay.doubled = 0.1;
  relay.swapped = 0.1;
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  for (int k = 0; k < 20; ++k) {
    run_ms(100);
    ASSERT_TRUE(status.following) << status.why_not;
  }
}

TEST_F(MavlinkProcesses, StrangersChangeNothing) {
  start_bridge();
  ASSERT_TRUE(until_following()) << status.why_not;
  Socket stranger;
  for (int k = 0; k < 50; ++k) {
    for (const Address from : {Address{1, 1}, Address{9, 1}}) {
      stranger.send(to_bytes(to_frame(Heartbeat{.custom_mode = 3U << 16U, .autopilot = 12}, from, 0)),
                    relay.bridge_port);
    }
    stranger.send(Bytes(100, 0xFD), relay.bridge_port);
    relay.to_bridge.send(to_bytes(to_frame(Heartbeat{.custom_mode = 3U << 16U, .autopilot = 12}, {9, 1}, 0)),
                         relay.bridge_port);
    run_ms(10);
    ASSERT_TRUE(status.following) << status.why_not;
  }
}

}  // namespace
}  // namespace tern::mavlink
