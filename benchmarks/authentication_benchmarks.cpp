// Cost of signing and verifying: single messages, and all messages of a second of flight.
#include <benchmark/benchmark.h>

#include <vector>

#include "runtime/authentication.h"

namespace tern {
namespace {

const KeyRing& ring() {
  static const KeyRing kRing = KeyRing::derive(random_key(), "benchmark");
  return kRing;
}

constexpr char kChannel[] = "BENCHMARK";

Bytes signed_message(std::size_t size, std::int64_t sequence) {
  Bytes message(size, 7);
  message.reserve(size + kTrailerBytes);
  sign(message, ring(), kChannel, kChannel, {{1, sequence}, UTime{1'000'000}});
  return message;
}

bool verifies(const Bytes& message, ReplayGuard& guard) {
  return verify(message, ring(), guard, kChannel, kChannel, UTime{1'000'000}).has_value();
}

void sign_message(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  Bytes message(size, 7);
  message.reserve(size + kTrailerBytes);
  for (auto _ : state) {
    message.resize(size);
    sign(message, ring(), kChannel, kChannel, {{1, 1}, UTime{1'000'000}});
    benchmark::DoNotOptimize(message.data());
  }
}
BENCHMARK(sign_message)->Arg(200)->Arg(10'000)->Arg(60'000)->Unit(benchmark::kMicrosecond);

void verify_message(benchmark::State& state) {
  const Bytes message = signed_message(static_cast<std::size_t>(state.range(0)), 1);
  for (auto _ : state) {
    ReplayGuard guard;
    benchmark::DoNotOptimize(verifies(message, guard));
  }
}
BENCHMARK(verify_message)->Arg(200)->Arg(10'000)->Arg(60'000)->Unit(benchmark::kMicrosecond);

/// Verifies all messages per second of a flight among 100 obstacles: 374 messages, 2.9 MB, of which PREDICTIONS are
/// 1.9 MB. The time in ms, divided by ten, is the percentage of a core.
void verify_a_second_of_a_flight(benchmark::State& state) {
  std::vector<Bytes> second;
  for (int k = 0; k < 374; ++k) {
    second.push_back(signed_message(k < 40 ? 47'500 : 3'000, k + 1));
  }
  for (auto _ : state) {
    ReplayGuard guard;
    for (const Bytes& message : second) benchmark::DoNotOptimize(verifies(message, guard));
  }
}
BENCHMARK(verify_a_second_of_a_flight)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tern
