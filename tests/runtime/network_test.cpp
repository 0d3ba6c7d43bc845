// Real processes over UDP multicast. Runs inside tests/support/hermetic.sh, which gives it a network of its own.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "messages/codec.h"
#include "runtime/service_manager.h"
#include "runtime/version.h"
#include "runtime/wall_runner.h"
#include "talker.h"
#include "tests/support/child_process.h"
#include "tests/support/network_end.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

std::vector<std::string> echo(std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), TERN_ECHO_PROCESS);
  return arguments;
}

class NetworkTest : public testing::Test, protected NetworkEnd {
 protected:
  NetworkTest() {
    bus->subscribe(Channel<Goal>{"GOAL_ANSWER"}, [this](const Goal& g) { answers.push_back(g); });
  }

  void send_goal(std::int64_t id) {
    Goal goal;
    goal.id = id;
    bus->publish(channels::kGoal, goal);
  }

  std::vector<Goal> answers;
};

TEST_F(NetworkTest, AProcessBeatsReportsAnswersAndEndsWithZeroOnSigterm) {
  std::vector<ConfigurationReport> reports;
  bus->subscribe(channels::kConfiguration, [&](const auto& r) { reports.push_back(r); });
  Child child(echo({"--set", "planner.period_s=2.5", "--set", "uav.start=[1,2,3]"}));
  ASSERT_TRUE(wait_until_ready());
  EXPECT_EQ(beats.back().process, "tern-echo");
  EXPECT_EQ(beats.back().build_id, build_id());
  ASSERT_FALSE(reports.empty());
  EXPECT_NE(reports[0].yaml.find("period_s: 2.5\n"), std::string::npos) << reports[0].yaml;
  EXPECT_NE(reports[0].yaml.find("start: [1, 2, 3]\n"), std::string::npos) << reports[0].yaml;
  for (int i = 1; i <= 200; ++i) send_goal(i);
  EXPECT_TRUE(wait_for([&] { return answers.size() == 200; }));
  EXPECT_EQ(bus->counters()["GOAL_ANSWER"].lost, 0);
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 0) << child.output;
}

/// A service manager's socket.
class Manager {
 public:
  Manager() : fd_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
    const std::string path = folder_.file("notify");
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) throw std::runtime_error("bind");
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
  }
  ~Manager() {
    unsetenv("NOTIFY_SOCKET");
    close(fd_);
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;
  /// The next report; "" after kPatienceMs.
  std::string next() {
    pollfd ready{fd_, POLLIN, 0};
    char text[1000];
    if (poll(&ready, 1, kPatienceMs) != 1) return "";
    return {text, static_cast<std::size_t>(std::max<ssize_t>(recv(fd_, text, sizeof(text), 0), 0))};
  }

 private:
  TempFolder folder_;
  int fd_;
};

TEST_F(NetworkTest, TheServiceManagerHearsThatAProcessIsReadyAliveAndStopping) {
  Manager manager;
  Child child(echo());
  ASSERT_TRUE(wait_until_ready());
  for (int beat = 0; beat < 3; ++beat) EXPECT_EQ(manager.next(), "READY=1\nWATCHDOG=1\nSTATUS=ready");
  child.signal(SIGTERM);
  std::string last;
  while (last != "STOPPING=1" && !(last = manager.next()).empty()) {
  }
  EXPECT_EQ(last, "STOPPING=1");
  EXPECT_EQ(child.wait(), 0) << child.output;
}

TEST(ServiceManagerTest, WithoutASocketThatWorksAProcessRunsAndSaysSo) {
  for (const char* none : {static_cast<const char*>(nullptr), "", "relative", "/nowhere/notify"}) {
    ServiceManager manager(none);
    EXPECT_FALSE(manager.exists());
    manager.alive({ProcessState::Ready, ""});
    manager.stopping();
  }
  EXPECT_FALSE(ServiceManager(("/" + std::string(200, 'x')).c_str()).exists());
}

TEST_F(NetworkTest, SigintEndsAProcessEvenIfItsParentIgnoredIt) {
  Child child(echo(), /*ignore_sigint=*/true);
  ASSERT_TRUE(wait_until_ready());
  child.signal(SIGINT);
  EXPECT_EQ(child.wait(), 0) << child.output;
}

TEST_F(NetworkTest, AFinishedNodeGivesItsExitCodeAndARestartedOneIsNoLoss) {
  for (int run = 0; run < 2; ++run) {
    Child child(echo());
    ASSERT_TRUE(wait_until_ready());
    send_goal(777);
    EXPECT_EQ(child.wait(), 7) << child.output;
  }
  EXPECT_TRUE(wait_for([&] { return answers.size() == 2; }));
  EXPECT_EQ(bus->counters()[channels::kHeartbeat.name].lost, 0);
}

TEST_F(NetworkTest, AnErrorInAHandlerEndsTheProcessWith70) {
  Child child(echo());
  ASSERT_TRUE(wait_until_ready());
  send_goal(666);
  EXPECT_EQ(child.wait(), kExitStuck);
  EXPECT_NE(child.output.find("internal error: asked to break"), std::string::npos) << child.output;
}

TEST_F(NetworkTest, GarbageOnItsChannelsDoesNotHarmAProcess) {
  Child child(echo());
  ASSERT_TRUE(wait_until_ready());
  for (unsigned size : {0U, 1U, 8U, 100U, 60'000U}) {
    const Bytes garbage(size, 0xff);
    lcm->publish(channels::kGoal.name, garbage.data(), size);
  }
  const auto refused = [&] {
    const auto found = beats.back().channels.find(channels::kGoal.name);
    if (found == beats.back().channels.end()) return false;
    std::int64_t sum = 0;
    for (const std::int64_t n : found->second.rejected) sum += n;
    return sum == 5;
  };
  EXPECT_TRUE(wait_for(refused));
  send_goal(1);
  EXPECT_TRUE(wait_for([&] { return answers.size() == 1; }));
}

TEST_F(NetworkTest, TheClockOffsetShiftsMessageTimesButNotTheEpoch) {
  Child child(echo({"--clock-offset-us", "-3600000000"}));
  ASSERT_TRUE(wait_until_ready());
  const Header& header = beats.back().header;
  EXPECT_LT((header.utime - clock.now()).us, -3'500'000'000);
  EXPECT_LT(clock.now().us - header.name.sender_epoch_us, 3'500'000'000);
}

TEST_F(NetworkTest, TheSuffixMovesAProcessToOtherChannels) {
  Child child(echo({"--channel-suffix", "_2"}));
  Bus second(lcm, clock, clock.now().us + 1, "_2");
  int count = 0;
  second.subscribe(channels::kHeartbeat, [&](const Heartbeat&) { ++count; });
  EXPECT_TRUE(wait_for([&] { return count > 0; }));
  EXPECT_TRUE(beats.empty());
}

// The network of this test is its own (hermetic.sh), so it may change it.
bool shell(const std::string& command) { return std::system(command.c_str()) == 0; }

TEST_F(NetworkTest, AProcessGoesOnWhenTheRouteMovesAndWhenItIsLost) {
  ASSERT_TRUE(
      shell("ip link add wl0 type veth peer name wl1 && ip link add en0 type veth peer name en1 &&"
            "for i in wl0 wl1 en0 en1; do ip link set $i up; done &&"
            "ip addr add 192.168.77.2/24 dev wl0 && ip addr add 192.168.88.2/24 dev en0 &&"
            "ip route del 224.0.0.0/4 dev lo && ip route add default dev wl0"));
  Child child(echo());
  EXPECT_TRUE(wait_until_ready());
  send_goal(1);
  EXPECT_TRUE(wait_for([&] { return answers.size() == 1; }));
  // Wi-Fi is lost, and a cable is in.
  EXPECT_TRUE(shell("ip route del default; ip link set wl0 down && ip route add default dev en0"));
  const auto hears_again = [this](std::size_t beats_before) {
    return wait_for([&] { return beats.size() >= beats_before + 3; });
  };
  EXPECT_TRUE(hears_again(beats.size())) << child.output;
  send_goal(2);
  EXPECT_TRUE(wait_for([&] { return answers.size() == 2; })) << "it hears on the other interface";
  // No route is left: this host's processes go on by loopback.
  EXPECT_TRUE(shell("ip route del default; ip link del en0"));
  EXPECT_TRUE(hears_again(beats.size()));
  EXPECT_TRUE(shell("ip link del wl0; ip route add 224.0.0.0/4 dev lo"));
  send_goal(3);
  EXPECT_TRUE(wait_for([&] { return answers.size() == 3; }));
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 0) << child.output;
  EXPECT_NE(child.output.find("no multicast route is left, messages go by the loopback interface"), std::string::npos);
}

TEST_F(NetworkTest, ANodeRunsOnTheWallClockUntilItFinishes) {
  Bus own(lcm, clock, clock.now().us + 1);
  Talker talker(own, {"t", Duration{1'000}, 20}, nullptr);
  NodeHost host(own, talker, "tern-talker", "");
  EXPECT_EQ(run_on_wall_clock(*lcm, host, -1), 7);
  EXPECT_GE(talker.steps(), 20);
}

TEST(Process, VersionAndHelpExitWithZero) {
  Child version(echo({"--version"}));
  EXPECT_EQ(version.wait(), 0);
  EXPECT_EQ(version.output, std::string("tern-echo ") + build_id() + "\n");
  Child help(echo({"--help"}));
  EXPECT_EQ(help.wait(), 0);
  for (const char* option :
       {"--config", "--set", "--lcm-url", "--clock-offset-us", "--channel-suffix", "--log-level"}) {
    EXPECT_NE(help.output.find(option), std::string::npos) << option;
  }
}

TEST(Process, BadOptionsAndConfigurationsExitWithTwoAndSayWhere) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--no-such-option"}, "--no-such-option"},
      {{"--log-level", "loud"}, "loud"},
      {{"--clock-offset-us", "soon"}, "soon"},
      {{"--config", "/no/such.yaml"}, "tern-echo: /no/such.yaml: cannot be read"},
      {{"--set", "planner.period_s=0"},
       "tern-echo: --set planner.period_s=0: planner.period_s: 0 is out of range (0, 10]"},
      {{"--set", "planner.typo=0"}, "planner.typo: unknown key (known here: period_s)"},
      {{"--set", "uav.limits.v_max=-3"}, "uav.limits.v_max: -3 is out of range [0.001, 1000]"},
      {{"--channel-suffix", ".*"}, ".*"},
  };
  for (const auto& [arguments, text] : cases) {
    Child child(echo(arguments));
    EXPECT_EQ(child.wait(), kExitBadConfiguration) << arguments[0] << "\n" << child.output;
    EXPECT_NE(child.output.find(text), std::string::npos) << child.output;
  }
}

TEST(Process, WithoutAMulticastRouteItSaysWhatToDoAndExitsWithThree) {
  Child child({"unshare", "-n", TERN_ECHO_PROCESS});
  EXPECT_EQ(child.wait(), kExitNoNetwork) << child.output;
  EXPECT_NE(child.output.find("ip route add 224.0.0.0/4 dev lo"), std::string::npos) << child.output;
}

}  // namespace
}  // namespace tern
