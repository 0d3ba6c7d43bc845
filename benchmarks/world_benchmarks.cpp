// Cost of preparation outside of planning, and of messages, on corridor_demo (100 obstacles, two regions).
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "campaign/virtual_system.h"
#include "messages/batching.h"
#include "messages/codec.h"

namespace tern {
namespace {

/// The messages of one second of corridor_demo.
struct Traffic {
  std::vector<MapChunk> chunks;
  VoxelMap map;
  FlightRecording flight;
};

const Traffic& traffic() {
  static const Traffic heard = [] {
    Traffic t;
    const std::string scenario = std::string(TERN_SCENARIOS) + "/corridor_demo.yaml";
    VirtualSystem system(scenario, {});
    MapAssembler assembler;
    bool complete = false;
    system.runner().observer().subscribe(channels::kSemanticMap, [&](const MapChunk& chunk) {
      if (complete) return;
      t.chunks.push_back(chunk);
      complete = assembler.add(chunk).value_or(false);
    });
    system.runner().run(system.runner().now() + Duration{60'000'000}, [&] { return complete; });
    t.map = assembler.take();
    t.flight = record_flight(scenario, {});
    return t;
  }();
  return heard;
}

const Moment& middle_of_the_flight() { return traffic().flight.moments[traffic().flight.moments.size() / 2]; }

void semantic_fields(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(SemanticFields(traffic().map).map_version());
  state.counters["voxels"] = static_cast<double>(traffic().map.grid.voxels());
}
BENCHMARK(semantic_fields)->Unit(benchmark::kMillisecond);

void goal_field(benchmark::State& state) {
  const Moment& m = middle_of_the_flight();
  std::vector<Box> statics;
  for (const PlanningObstacle& o : m.world.predictions->obstacles) {
    if (!o.moves()) statics.push_back(o.box);
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(make_goal_field(m.world.goal->key, m.world.map, statics, m.request.start.p));
  }
}
BENCHMARK(goal_field)->Unit(benchmark::kMillisecond);

/// Boxes and index of a prediction set.
void prediction_products(benchmark::State& state) {
  const TrackSet& set = middle_of_the_flight().world.predictions->set;
  for (auto _ : state) benchmark::DoNotOptimize(PredictionProducts(set).obstacles.data());
}
BENCHMARK(prediction_products)->Unit(benchmark::kMicrosecond);

/// All chunks of the map: decoding, checking, assembling.
void map_decode(benchmark::State& state) {
  std::vector<Bytes> wire;
  for (const MapChunk& chunk : traffic().chunks) wire.push_back(encode(chunk));
  for (auto _ : state) {
    MapAssembler assembler;
    for (const Bytes& bytes : wire) benchmark::DoNotOptimize(assembler.add(*decode<MapChunk>(bytes)).value_or(false));
  }
  state.counters["chunks"] = static_cast<double>(wire.size());
}
BENCHMARK(map_decode)->Unit(benchmark::kMillisecond);

template <auto make>
void encode_message(benchmark::State& state) {
  const auto value = make();
  for (auto _ : state) benchmark::DoNotOptimize(encode(value).data());
  state.counters["bytes"] = static_cast<double>(encode(value).size());
}

template <auto make>
void decode_message(benchmark::State& state) {
  const Bytes bytes = encode(make());
  for (auto _ : state) benchmark::DoNotOptimize(decode<decltype(make())>(bytes).has_value());
}

HorizonRequest request() { return middle_of_the_flight().request; }
TrackSet batch() { return split_batches(middle_of_the_flight().world.predictions->set).front(); }
Plan answer() {
  const Moment& m = middle_of_the_flight();
  Budget budget = Budget::unlimited();
  Plan answered = plan(m.request, m.world, traffic().flight.config, budget).plan;
  answered.header = m.request.header;
  return answered;
}

BENCHMARK(encode_message<batch>)->Name("encode_predictions")->Unit(benchmark::kMicrosecond);
BENCHMARK(decode_message<batch>)->Name("decode_predictions")->Unit(benchmark::kMicrosecond);
BENCHMARK(encode_message<request>)->Name("encode_request")->Unit(benchmark::kMicrosecond);
BENCHMARK(decode_message<request>)->Name("decode_request")->Unit(benchmark::kMicrosecond);
BENCHMARK(encode_message<answer>)->Name("encode_plan")->Unit(benchmark::kMicrosecond);
BENCHMARK(decode_message<answer>)->Name("decode_plan")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tern
