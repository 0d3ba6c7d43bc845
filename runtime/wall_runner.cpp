#include "runtime/wall_runner.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "runtime/lcm_network.h"

namespace tern {
namespace {

/// Most messages, and longest time, between two steps. A flood must not keep the node from its deadlines, its heartbeat
/// and SIGTERM.
constexpr int kMaxMessagesPerStep = 1'000;
constexpr Duration kMaxTimePerStep{20'000};
constexpr Duration kMaxTimeAtStop{100'000};  // after SIGTERM
/// Longest sleep. A node that only reacts to messages has no wakeup (kNever).
constexpr Duration kMaxSleep{1'000'000};

/// Blocks until a descriptor is readable or the time has come. @return whether fds[1], the stop, is readable.
bool wait(pollfd (&fds)[2], Duration sleep) {
  const std::int64_t us = std::clamp(sleep, Duration{0}, kMaxSleep).us;
  const timespec timeout{us / 1'000'000, (us % 1'000'000) * 1'000};
  if (ppoll(fds, 2, &timeout, nullptr) < 0) {
    if (errno == EINTR) return false;
    throw std::runtime_error(fmt::format("ppoll: {}", std::strerror(errno)));
  }
  if ((fds[0].revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) throw std::runtime_error("LCM's file descriptor failed");
  return fds[1].revents != 0;
}

/// Takes one signal, so that the next one is seen.
void take_signal(int stop_fd) {
  signalfd_siginfo info;
  if (read(stop_fd, &info, sizeof(info)) < 0 && errno != EAGAIN && errno != EINTR) {
    throw std::runtime_error(fmt::format("signalfd: {}", std::strerror(errno)));
  }
}

}  // namespace

int run_on_wall_clock(lcm::LCM& lcm, NodeHost& host, int stop_fd) {
  const Clock& clock = host.bus().clock();
  pollfd fds[2] = {{lcm.getFileno(), POLLIN, 0}, {stop_fd, POLLIN, 0}};
  while (true) {
    drain(lcm, kMaxMessagesPerStep, kMaxTimePerStep);
    host.bus().rethrow();
    const UTime now = clock.now();
    if (host.is_due(now)) host.step(now);
    if (const auto code = host.node().finished()) return *code;
    const UTime wakeup = host.next_wakeup();
    const Duration sleep = std::min(wakeup - clock.now(), kMaxSleep);
    if (wait(fds, clock.in_system_time(sleep))) {
      take_signal(stop_fd);
      if (!host.end(clock.now())) continue;
      // A recorder keeps all messages that have arrived; the others only look at them.
      drain(lcm, kListenCapacity, host.bus().listens() ? std::nullopt : std::optional(kMaxTimeAtStop));
      host.bus().rethrow();
      return 0;
    }
  }
}

}  // namespace tern
