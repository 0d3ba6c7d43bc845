#include "runtime/wall_runner.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>
#include <utility>

#include "runtime/lcm_network.h"
#include "runtime/log.h"
#include "runtime/service_manager.h"

namespace tern {
namespace {

/// Most messages, and longest time, between two steps. A flood must not keep the node from its deadlines, its heartbeat
/// and SIGTERM.
constexpr int kMaxMessagesPerStep = 1'000;
constexpr Duration kMaxTimePerStep{20'000};
constexpr Duration kMaxTimeAtStop{100'000};  // after SIGTERM
/// Longest sleep, in the system's time: then interfaces and routes are looked at. A node that only reacts to messages
/// has no wakeup (kNever).
constexpr Duration kMaxSleep{100'000};

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

/// Returns how many heartbeats the process has sent.
std::int64_t heartbeats_of(const Bus& bus) { return bus.counters()[channels::kHeartbeat.name].sent; }

/// Finds out that no message comes in, not even the own heartbeats.
class HearingWatch {
 public:
  explicit HearingWatch(const Bus& bus) : bus_(bus), heard_at_(bus.clock().now()) {}
  /// @return true once per kDeaf without a message in which several heartbeats were sent
  /// @pre no message waits to be handled
  bool is_deaf(UTime now) {
    if (bus_.deliveries() != deliveries_) {
      deliveries_ = bus_.deliveries();
      begin(now);
    }
    if (now - heard_at_ <= kDeaf || heartbeats() < sent_ + kSeveral) return false;
    begin(now);
    return true;
  }

 private:
  static constexpr Duration kDeaf{2'000'000};
  static constexpr std::int64_t kSeveral = 3;
  [[nodiscard]] std::int64_t heartbeats() const { return heartbeats_of(bus_); }
  void begin(UTime now) {
    heard_at_ = now;
    sent_ = heartbeats();
  }

  const Bus& bus_;
  UTime heard_at_;
  std::int64_t deliveries_ = 0, sent_ = 0;
};

/// Adapts the sockets to the network every kMaxSleep.
class NetworkKeeper {
 public:
  NetworkKeeper(MulticastSockets* sockets, const Bus& bus) : sockets_(sockets), bus_(bus), hearing_(bus) {}
  /// @param is_quiet  no message waits to be handled
  void keep(bool is_quiet) {
    using Steady = std::chrono::steady_clock;
    if (sockets_ == nullptr || Steady::now() < next_) return;
    next_ = Steady::now() + std::chrono::microseconds(kMaxSleep.us);
    sockets_->follow();
    if (!is_quiet || !hearing_.is_deaf(bus_.clock().now())) return;
    log::warn("network: did not hear its own heartbeats for 2 s, joins the multicast group anew");
    sockets_->join_anew();
  }

 private:
  MulticastSockets* sockets_;
  const Bus& bus_;
  HearingWatch hearing_;
  std::chrono::steady_clock::time_point next_{};
};

/// Tells the service manager of the process's heartbeats, at most every kMaxSleep.
class AliveReports {
 public:
  explicit AliveReports(NodeHost& host) : host_(host), manager_(std::getenv("NOTIFY_SOCKET")) {}
  void report() {
    using Steady = std::chrono::steady_clock;
    if (!manager_.exists() || Steady::now() < next_) return;
    next_ = Steady::now() + std::chrono::microseconds(kMaxSleep.us);
    const std::int64_t sent = heartbeats_of(host_.bus());
    if (std::exchange(reported_, sent) != sent) manager_.alive(host_.node().health());
  }
  void stopping() { manager_.stopping(); }

 private:
  NodeHost& host_;
  ServiceManager manager_;
  std::int64_t reported_ = 0;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace

int run_on_wall_clock(lcm::LCM& lcm, NodeHost& host, int stop_fd, MulticastSockets* sockets) {
  const Clock& clock = host.bus().clock();
  NetworkKeeper network(sockets, host.bus());
  AliveReports manager(host);
  pollfd fds[2] = {{lcm.getFileno(), POLLIN, 0}, {stop_fd, POLLIN, 0}};
  while (true) {
    drain(lcm, kMaxMessagesPerStep, kMaxTimePerStep);
    host.bus().rethrow();
    const UTime now = clock.now();
    if (host.is_due(now)) host.step(now);
    manager.report();
    if (const auto code = host.node().finished()) return *code;
    const UTime wakeup = host.next_wakeup();
    const Duration sleep = std::min(wakeup - clock.now(), kMaxSleep);
    if (wait(fds, clock.in_system_time(sleep))) {
      take_signal(stop_fd);
      manager.stopping();
      if (!host.end(clock.now())) continue;
      // A recorder keeps all messages that have arrived; the others only look at them.
      drain(lcm, kListenCapacity, host.bus().listens() ? std::nullopt : std::optional(kMaxTimeAtStop));
      host.bus().rethrow();
      return 0;
    }
    network.keep(fds[0].revents == 0);
  }
}

}  // namespace tern
