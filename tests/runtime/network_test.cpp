// Real processes over UDP multicast. Runs inside tests/support/hermetic.sh, which gives it a network of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <lcm/lcm-cpp.hpp>

#include "messages/configuration_report.h"
#include "messages/goal.h"
#include "messages/heartbeat.h"
#include "runtime/channels.h"
#include "runtime/lcm_network.h"
#include "runtime/version.h"
#include "runtime/wall_runner.h"
#include "talker.h"

namespace tern {
namespace {

/// How long a test waits for what must come; no test asserts a time.
constexpr int kPatienceMs = 20'000;

/// A child process with its stdout and stderr.
class Child {
 public:
  /// @param argv  the program first  @param ignore_sigint  as a script's background job has it
  explicit Child(std::vector<std::string> argv, bool ignore_sigint = false) {
    int pipe_fds[2];
    if (pipe(pipe_fds) != 0) throw std::runtime_error("pipe");
    pid_ = fork();
    if (pid_ == 0) {
      if (ignore_sigint) std::signal(SIGINT, SIG_IGN);
      dup2(pipe_fds[1], STDOUT_FILENO);
      dup2(pipe_fds[1], STDERR_FILENO);
      close(pipe_fds[0]);
      std::vector<char*> arguments;
      for (std::string& argument : argv) arguments.push_back(argument.data());
      arguments.push_back(nullptr);
      execvp(arguments[0], arguments.data());
      _exit(126);
    }
    close(pipe_fds[1]);
    output_fd_ = pipe_fds[0];
  }
  ~Child() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    close(output_fd_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void signal(int number) const { kill(pid_, number); }

  /// Waits for its end. @return the exit code, −signal if a signal ended it. `output` then holds all it said.
  int wait() {
    char buffer[4096];
    pollfd fd{output_fd_, POLLIN, 0};
    while (true) {
      if (poll(&fd, 1, kPatienceMs) == 0) kill(pid_, SIGKILL);
      const ssize_t n = read(output_fd_, buffer, sizeof(buffer));
      if (n <= 0) break;
      output.append(buffer, static_cast<std::size_t>(n));
    }
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string output;

 private:
  pid_t pid_ = 0;
  int output_fd_ = -1;
};

std::vector<std::string> echo(std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), TERN_ECHO_PROCESS);
  return arguments;
}

/// The test's own end of the network.
class NetworkTest : public testing::Test {
 protected:
  NetworkTest() {
    auto opened = open_lcm(choose_lcm_url("", nullptr));
    if (!opened) throw std::runtime_error(opened.error().message + " (run this test by tests/support/hermetic.sh)");
    lcm = *opened;
    bus = std::make_unique<Bus>(lcm, clock, clock.now().us);
    bus->subscribe<Heartbeat>(channels::kHeartbeat, [this](const Heartbeat& h) { beats.push_back(h); });
    bus->subscribe<Goal>("GOAL_ANSWER", [this](const Goal& g) { answers.push_back(g); });
  }

  /// Handles messages until the condition holds. @return whether it did within kPatienceMs.
  bool wait_for(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatienceMs);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      pollfd fd{lcm->getFileno(), POLLIN, 0};
      poll(&fd, 1, 100);
      drain(*lcm, 1'000);
      bus->rethrow();
    }
    return true;
  }

  /// Waits for a process that has not been heard before.
  bool wait_until_ready() {
    const std::int64_t last_epoch_us = beats.empty() ? 0 : beats.back().header.name.sender_epoch_us;
    return wait_for([&] { return !beats.empty() && beats.back().header.name.sender_epoch_us > last_epoch_us; });
  }

  void send_goal(std::int64_t id) {
    Goal goal;
    goal.id = id;
    bus->publish(channels::kGoal, goal);
  }

  std::shared_ptr<lcm::LCM> lcm;
  WallClock clock;
  std::unique_ptr<Bus> bus;
  std::vector<Heartbeat> beats;
  std::vector<Goal> answers;
};

TEST_F(NetworkTest, AProcessBeatsReportsAnswersAndEndsWithZeroOnSigterm) {
  std::vector<ConfigurationReport> reports;
  bus->subscribe<ConfigurationReport>(channels::kConfiguration, [&](const auto& r) { reports.push_back(r); });
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
  EXPECT_EQ(bus->counters()[channels::kHeartbeat].lost, 0);
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
    lcm->publish(channels::kGoal, garbage.data(), size);
  }
  const auto refused = [&] {
    const auto found = beats.back().channels.find(channels::kGoal);
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
  second.subscribe<Heartbeat>(channels::kHeartbeat, [&](const Heartbeat&) { ++count; });
  EXPECT_TRUE(wait_for([&] { return count > 0; }));
  EXPECT_TRUE(beats.empty());
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
      {{"--set", "uav.limits.v_max=-3"}, "uav.limits.v_max: -3 is out of range (0, 1000]"},
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
