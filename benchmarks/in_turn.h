// Benchmarks one operation over many inputs, so that no single input decides the result.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

namespace tern {

/// Measures ask(case) for one case after the other, and starts over at the end of the list.
template <class Case, class Ask>
void in_turn(benchmark::State& state, const std::vector<Case>& cases, const Ask& ask) {
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(cases[k++ % cases.size()]));
}

}  // namespace tern
