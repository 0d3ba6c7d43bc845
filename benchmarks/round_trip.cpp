// Measures a message and its answer between two processes over UDP multicast, without and with keys.
//
// Run it in a network namespace: tests/support/hermetic.sh build/release/bin/round_trip. Rounds without and with keys
// alternate. Percentiles are per round; the medians over the rounds are printed.
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <vector>

#include "core/base/digest.h"
#include "core/base/percentiles.h"
#include "messages/codec.h"
#include "runtime/bus.h"
#include "runtime/config.h"
#include "runtime/lcm_network.h"

namespace tern {
namespace {

constexpr int kRounds = 9, kPings = 1'000;
constexpr int kPeriodUs = 2'000, kPatienceMs = 1'000;
constexpr Channel<ConfigurationReport> kPing{"PING"}, kPong{"PONG"};

struct End {
  explicit End(const std::optional<Key>& master) {
    lcm = value_or_throw(open_lcm(choose_lcm_url("", nullptr)));
    std::optional<KeyRing> keys;
    if (master) keys = KeyRing::derive(*master, "round-trip");
    bus = std::make_unique<Bus>(lcm, clock, clock.now().us, "", std::move(keys));
  }
  bool receive() {
    pollfd fd{lcm->getFileno(), POLLIN, 0};
    if (poll(&fd, 1, kPatienceMs) <= 0) return false;
    drain(*lcm, 1'000);
    return true;
  }
  WallClock clock;
  std::shared_ptr<lcm::LCM> lcm;
  std::unique_ptr<Bus> bus;
};

[[noreturn]] void answer(const std::optional<Key>& master) {
  End end(master);
  end.bus->subscribe(kPing, [&](const ConfigurationReport& m) { end.bus->publish(kPong, m); });
  while (true) end.receive();
}

struct Round {
  double p50_us, p99_us, cpu_us;  ///< CPU time of this end, per round trip
};

double cpu_us() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto us = [](const timeval& t) { return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_usec); };
  return us(usage.ru_utime) + us(usage.ru_stime);
}

Round play(const std::optional<Key>& master, std::size_t bytes) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) answer(master);
  End end(master);
  std::int64_t answered = 0;
  end.bus->subscribe(kPong, [&](const ConfigurationReport&) { ++answered; });
  ConfigurationReport message;
  message.process = "round-trip";
  message.yaml = std::string(bytes, 'x');
  message.hash = digest(message.yaml);
  const auto trip = [&]() -> std::optional<double> {
    const std::int64_t before = answered;
    const UTime start = end.clock.now();
    end.bus->publish(kPing, message);
    while (answered == before) {
      if (!end.receive()) return std::nullopt;
    }
    return static_cast<double>((end.clock.now() - start).us);
  };
  while (!trip()) continue;
  std::vector<double> times;
  const double cpu_before = cpu_us();
  while (times.size() < kPings) {
    usleep(kPeriodUs);
    if (const auto time = trip()) times.push_back(*time);
  }
  const double cpu = (cpu_us() - cpu_before) / kPings;
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const Percentiles took = percentiles(times);
  return {took.p50, took.p99, cpu};
}

void measure(std::size_t bytes) {
  std::vector<double> values[2][3];
  for (int k = 0; k < kRounds; ++k) {
    for (const int with_keys : {0, 1}) {
      const Round round = play(with_keys == 1 ? std::optional(random_key()) : std::nullopt, bytes);
      for (const auto& [at, value] : {std::pair{0, round.p50_us}, {1, round.p99_us}, {2, round.cpu_us}}) {
        values[with_keys][at].push_back(value);
      }
    }
  }
  for (const int with_keys : {0, 1}) {
    const auto* v = values[with_keys];
    fmt::print("{:>6} bytes, {:>7} keys: p50 {:6.0f} us, p99 {:6.0f} us, CPU {:5.0f} us\n", bytes,
               with_keys == 1 ? "with" : "without", percentiles(v[0]).p50, percentiles(v[1]).p50,
               percentiles(v[2]).p50);
  }
}

}  // namespace
}  // namespace tern

int main() {
  for (const std::size_t bytes : {200U, 10'000U, 49'000U}) tern::measure(bytes);
}
