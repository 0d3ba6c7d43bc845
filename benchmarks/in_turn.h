// Measures a piece of work on many cases, so that no single one decides what it costs.
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

namespace tern {

/// Measures ask(case): of one case after the other, again from the first.
template <class Case, class Ask>
void in_turn(benchmark::State& state, const std::vector<Case>& cases, const Ask& ask) {
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(cases[k++ % cases.size()]));
}

}  // namespace tern
