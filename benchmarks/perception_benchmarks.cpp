// Cost of a frame of a simulated camera and lidar in the forest of SANDO: rendering, noise, detection, view.
#include <benchmark/benchmark.h>

#include <iterator>
#include <memory>
#include <vector>

#include "benchmarks/in_turn.h"
#include "perception/rasterizer.h"
#include "simulator/sensors/depth_sensor.h"
#include "simulator/worlds/world.h"

namespace tern {
namespace {

struct Frame {
  SensorPose pose;
  std::vector<Box> boxes;
};

// Frames along a flight at 5 m/s.
std::vector<Frame> forest_frames() {
  Scenario scenario;
  scenario.seed = 7;
  scenario.world.generator = "sando_forest";
  scenario.world.count = 200;
  scenario.uav.start = Vec3(0, 0, 2);
  scenario.uav.goal = Vec3(105, 0, 2);
  const World world = make_world(scenario, "").value();
  std::vector<Frame> frames;
  for (double x = 2.0; x < 90.0; x += 1.5) {
    Frame frame{looking(Vec3(x, 0, 2), 0.0), {}};
    for (const TrueObstacle& o : true_obstacles(world, x / 5.0)) {
      frame.boxes.push_back(box_around(o.position, o.half_extents));
    }
    frames.push_back(frame);
  }
  return frames;
}

DepthSensorConfig sensor_of(const benchmark::State& state) {
  return state.range(0) == 0 ? default_camera() : default_lidar();
}

// 0: camera, 1: lidar
void rasterize(benchmark::State& state) {
  DepthPicture picture(std::make_shared<RayGrid>(sensor_of(state).optics));
  Rasterizer rasterizer;
  in_turn(state, forest_frames(), [&](const Frame& frame) {
    rasterizer.begin(picture, frame.pose);
    for (const Box& box : frame.boxes) rasterizer.add(picture, box);
    rasterizer.add_ground(picture, 0.0);
    rasterizer.end(picture);
    return picture.depths()[0];
  });
}
BENCHMARK(rasterize)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void add_noise_to_a_picture(benchmark::State& state) {
  DepthPicture picture(std::make_shared<RayGrid>(sensor_of(state).optics));
  std::int64_t number = 0;
  for (auto _ : state) {
    picture.depths().setConstant(5.0F);
    add_noise(picture, 1, 0, ++number);
  }
}
BENCHMARK(add_noise_to_a_picture)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void whole_frame(benchmark::State& state) {
  SimulatedDepthSensor sensor(sensor_of(state), 0, 1);
  std::int64_t number = 0, sightings = 0;
  in_turn(state, forest_frames(), [&](const Frame& frame) {
    const SightingSet set = sensor.look({frame.boxes, {}, 0.0}, frame.pose, frame.pose, UTime{}, ++number);
    sightings += std::ssize(set.sightings);
    return set.left_out;
  });
  state.counters["sightings"] = static_cast<double>(sightings) / static_cast<double>(number);
}
BENCHMARK(whole_frame)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tern
