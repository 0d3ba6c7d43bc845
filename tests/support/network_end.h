// A test's own connection to a real LCM network. It receives the heartbeats of the processes.
#pragma once

#include <poll.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "messages/codec.h"
#include "runtime/bus.h"
#include "runtime/lcm_network.h"
#include "tests/support/child_process.h"

namespace tern {

struct NetworkEnd {
  NetworkEnd() {
    auto opened = open_lcm(choose_lcm_url("", nullptr));
    if (!opened) throw std::runtime_error(opened.error().message + " (run this test by tests/support/hermetic.sh)");
    lcm = *opened;
    bus = std::make_unique<Bus>(lcm, clock, clock.now().us);
    bus->subscribe(channels::kHeartbeat, [this](const Heartbeat& h) { beats.push_back(h); });
  }

  /// Handles messages until the condition holds. @return false if it does not within kPatienceMs
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

  /// Waits for the first heartbeat of a new process.
  bool wait_until_ready() {
    const std::int64_t last_epoch_us = beats.empty() ? 0 : beats.back().header.name.sender_epoch_us;
    return wait_for([&] { return !beats.empty() && beats.back().header.name.sender_epoch_us > last_epoch_us; });
  }

  std::shared_ptr<lcm::LCM> lcm;
  /// The clock, at the pace of the processes that this test starts.
  WallClock clock{{}, std::getenv("TERN_PACE") != nullptr ? std::stod(std::getenv("TERN_PACE")) : 1.0};
  std::unique_ptr<Bus> bus;
  std::vector<Heartbeat> beats;
};

}  // namespace tern
