// Cost of preparation outside of planning, and of messages, on corridor_demo (100 obstacles, two regions).
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "benchmarks/flight_recording.h"
#include "campaign/virtual_system.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "planner/semantics/seen_cells.h"

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

/// The pose of a vehicle at (0, 0, 1) that has estimated it for a minute.
PoseError pose_error() {
  PoseError error;
  error.position = Vec3(0, 0, 1);
  for (std::size_t k = 0; k < 6; ++k) error.pose_covariance[7 * k] = k < 3 ? 0.01 : 1e-5;
  error.pose_covariance[5] = error.pose_covariance[30] = 1e-4;
  return error;
}

/// The margin of one box of the map, as a plan takes it for each box in reach.
void map_margin(benchmark::State& state) {
  const PoseError error = pose_error();
  const Box box(Vec3(2, -1, 0), Vec3(2.5, 3, 2));
  for (auto _ : state) benchmark::DoNotOptimize(error.margin(box));
}
BENCHMARK(map_margin)->Unit(benchmark::kNanosecond);

/// The cells of a frame over a map of ground and one region, with the boxes at rest that are near.
void seen_cells_of_a_frame(benchmark::State& state) {
  VoxelMap map;
  map.grid.origin = Vec3(-10, -20, 0);
  map.grid.resolution = 0.5;
  map.grid.size = {80, 80, 4};
  map.labels.assign(static_cast<std::size_t>(map.grid.voxels()), VoxelLabel::Repulsive);
  map.classes.assign(map.labels.size(), 1);
  map.class_names = {"", "water"};
  const SurfaceMap labels(map, {});
  std::vector<Box> at_rest;
  for (std::int64_t k = 0; k < state.range(0); ++k)
    at_rest.push_back(box_around(
        Vec3(3.0 + 0.4 * static_cast<double>(k % 12), -4.0 + 0.3 * static_cast<double>(k), 1.0), Vec3(0.1, 0.1, 1.0)));
  FeatureFrame frame;
  for (int k = 0; k < 100; ++k) {
    StereoFeature& feature = frame.features.emplace_back();
    feature.id = k;
    feature.left = {-0.8 + 0.016 * k, 0.05 + 0.004 * k};
    feature.right = feature.left - Eigen::Vector2d(frame.baseline_m / 4.0, 0.0);
    feature.has_right = true;
  }
  CameraPose camera;
  camera.eye = Vec3(0, 0, 1.2);
  camera.R_WC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.error = pose_error();
  const std::vector<Box> movers;
  for (auto _ : state) benchmark::DoNotOptimize(seen_cells(frame, camera, {labels, at_rest, movers}).data());
}
BENCHMARK(seen_cells_of_a_frame)->Arg(0)->Arg(30)->Unit(benchmark::kMicrosecond);

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
