// launch_noise_process SEED PER_SECOND SECONDS: sends mutated copies of the messages on LCM_DEFAULT_URL, prints their
// number.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <thread>

#include "tests/support/traffic_mutator.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const double per_second = std::stod(argv[2]), seconds = std::stod(argv[3]);
  lcm::LCM network;
  if (!network.good()) return 3;
  tern::testing::TrafficMutator mutator(std::stoull(argv[1]));
  const auto hear = [&](const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    mutator.hear(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
  };
  network.subscribeFunction(
      ".*",
      +[](const lcm::ReceiveBuffer* buffer, const std::string& channel, const decltype(hear)* handler) {
        (*handler)(buffer, channel);
      },
      &hear);
  const auto began = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(); };
  std::int64_t sent = 0;
  while (elapsed() < seconds) {
    while (network.handleTimeout(0) > 0) {
    }
    while (mutator.has_heard() && static_cast<double>(sent) < per_second * elapsed()) {
      const auto copy = mutator.next();
      network.publish(copy.channel, copy.bytes.data(), static_cast<unsigned>(copy.bytes.size()));
      ++sent;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  fmt::print("{} sent\n", sent);
  return 0;
}
