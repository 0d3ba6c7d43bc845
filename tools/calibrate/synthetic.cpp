#include "tools/calibrate/synthetic.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/random.h"

namespace tern::calibrate {
namespace {

constexpr double kDuration = 12.0, kRate = 30.0, kLatency = 0.05, kDropout = 0.05;
struct Sensor {
  double sigma;  // m
  int every;     // of kRate frames
};
constexpr std::array<Sensor, 4> kSensors{{{0.05, 1}, {0.0, 1}, {0.02, 3}, {0.1, 2}}};
constexpr int kAtOnce = 12;
constexpr double kApart = 20.0;  // m
constexpr std::array kShortest{1.5, 9.0};
constexpr int kWaves = 4;

// The loop that all obstacles of one recording share: its shape and rate.
struct Loop {
  double omega = 0.0;  // rad/s
  int harmonic = 2;
  Eigen::Array3d first, second, turned[2];  // amplitudes of position and phases per axis
};
Loop draw_loop(Rng& rng) {
  Loop loop;
  loop.omega = rng.uniform(0.5, 1.5);
  loop.harmonic = rng.uniform() < 0.5 ? 2 : 3;
  for (int axis = 0; axis < 3; ++axis) {
    const double flat = axis == 2 ? 0.5 : 1.0;
    loop.first[axis] = flat * rng.uniform(0.5, 2.0);
    loop.second[axis] = flat * rng.uniform(0.0, 1.0);
    for (auto& turned : loop.turned) turned[axis] = rng.uniform(0.0, 2.0 * std::numbers::pi);
  }
  return loop;
}

// One obstacle, advanced frame by frame.
class Mover {
 public:
  Mover(SyntheticMotion kind, const Loop& loop, const Vec3& place, Rng& rng) : kind_(kind), p_(place) {
    switch (kind) {
      case SyntheticMotion::Walkers:
        head_out(rng, rng.uniform(0.5, 1.8));
        q_ = rng.uniform(0.08, 0.25);
        sway_ = rng.uniform(0.0, 0.05);
        break;
      case SyntheticMotion::Wanderers: waves(rng, rng.uniform(0.2, 1.2), rng.uniform(1.0, 4.0)); break;
      case SyntheticMotion::Racers:
        jumps_ = rng.uniform() < 0.5;
        jumps_ ? head_out(rng, rng.uniform(1.0, 8.0)) : waves(rng, rng.uniform(1.5, 6.0), rng.uniform(0.5, 2.0));
        break;
      case SyntheticMotion::Drifters:
        v_ = Vec3(rng.normal(), rng.normal(), 0.3 * rng.normal());
        q_ = rng.uniform(0.3, 0.9);
        break;
      case SyntheticMotion::Turners: head_out(rng, rng.uniform(0.8, 2.0)); break;
      case SyntheticMotion::Loopers: go_round(loop, rng); break;
    }
  }

  Vec3 step(Rng& rng) {
    const double dt = 1.0 / kRate;
    t_ += dt;
    if (kind_ == SyntheticMotion::Turners && rng.uniform() < 0.3 * dt) head_out(rng, v_.norm());
    if (jumps_ && rng.uniform() < dt) a_ = 5.0 * Vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    if (jumps_ && v_.norm() > 9.0) a_ = -0.5 * v_;
    Vec3 v = v_;
    for (const Wave& wave : waves_) v += (wave.v.array() * (wave.omega * t_ + wave.phase).sin()).matrix();
    p_ += v * dt;
    v_ += a_ * dt;
    for (int axis = 0; axis < 3; ++axis) v_[axis] += q_ * std::sqrt(dt) * rng.normal() * (axis == 2 ? 0.3 : 1.0);
    return p_ + sway_ * std::sin(2.0 * std::numbers::pi * 0.9 * t_) * Vec3(v_.y(), -v_.x(), 0.0).normalized();
  }

 private:
  struct Wave {
    Eigen::Array3d omega, phase;
    Vec3 v;
  };
  void head_out(Rng& rng, double speed) {
    const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
    v_ = speed * Vec3(std::cos(angle), std::sin(angle), 0.0);
  }
  // The loop with a size and phase of its own.
  void go_round(const Loop& loop, Rng& rng) {
    const double size = rng.uniform(0.7, 1.4), phase = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const auto wave = [&](int harmonic, const Eigen::Array3d& amplitude, const Eigen::Array3d& turned) {
      const double omega = harmonic * loop.omega;
      waves_.push_back({Eigen::Array3d::Constant(omega), turned + harmonic * phase, size * omega * amplitude});
    };
    wave(1, loop.first, loop.turned[0]);
    wave(loop.harmonic, loop.second, loop.turned[1]);
  }
  void waves(Rng& rng, double speed, double lasts_s) {
    for (int k = 0; k < kWaves; ++k) {
      Wave wave;
      for (int axis = 0; axis < 3; ++axis) {
        wave.omega[axis] = std::abs(rng.normal()) / lasts_s;
        wave.phase[axis] = rng.uniform(0.0, 2.0 * std::numbers::pi);
        wave.v[axis] = speed * rng.uniform(0.3, 1.0) / std::sqrt(kWaves) * (axis == 2 ? 0.6 : 1.0);
      }
      waves_.push_back(wave);
    }
  }

  SyntheticMotion kind_;
  Vec3 p_, v_ = Vec3::Zero(), a_ = Vec3::Zero();
  double q_ = 0.0, sway_ = 0.0, t_ = 0.0;
  bool jumps_ = false;
  std::vector<Wave> waves_;
};

}  // namespace

const std::vector<SyntheticSource>& synthetic_sources() {
  static const std::vector<SyntheticSource> sources{
      {SyntheticMotion::Walkers, "walkers", 1.0},   {SyntheticMotion::Wanderers, "wanderers", 1.0},
      {SyntheticMotion::Racers, "racers", 1.0},     {SyntheticMotion::Loopers, "loopers", 1.0, false},
      {SyntheticMotion::Drifters, "drifters", 0.1}, {SyntheticMotion::Turners, "turners", 0.02}};
  return sources;
}

Recording synthetic_recording(const SyntheticSource& source, std::uint64_t seed) {
  struct Present {
    Mover mover;
    double until_s;
    std::int64_t id;
  };
  Rng rng(seed);
  const Loop loop = source.motion == SyntheticMotion::Loopers ? draw_loop(rng) : Loop{};
  const Sensor& sensor = kSensors[seed % kSensors.size()];
  Recording recording;
  recording.name = std::string(source.name);
  std::vector<Present> present;
  present.reserve(kAtOnce);
  std::int64_t ids = 0;
  const auto arrive = [&](int slot, double t) {
    const Vec3 place(kApart * kApart * slot, kApart * static_cast<double>(ids % 50), 1.0);
    return Present{Mover(source.motion, loop, place, rng), t + rng.uniform(kShortest[0], kShortest[1]), ids++};
  };
  for (int slot = 0; slot < kAtOnce; ++slot) present.push_back(arrive(slot, 0.0));
  for (int frame = 0; frame < static_cast<int>(kDuration * kRate); ++frame) {
    Received received;
    received.set.at = UTime{} + Duration::from_seconds(1.0 + frame / kRate);
    received.at = received.set.at + Duration::from_seconds(kLatency);
    for (int slot = 0; slot < kAtOnce; ++slot) {
      Present& one = present[idx(slot)];
      if (frame / kRate > one.until_s) one = arrive(slot, frame / kRate);
      TruePath& truth = recording.truth[one.id];
      truth.half_extents = Vec3::Constant(0.3);
      const Vec3 p = one.mover.step(rng);
      truth.centres[received.set.at] = p;
      if (rng.uniform() < kDropout || frame % sensor.every != 0) continue;
      Detection detection;
      for (int axis = 0; axis < 3; ++axis) detection.position[axis] = p[axis] + sensor.sigma * rng.normal();
      detection.half_extents = truth.half_extents;
      detection.variance = Vec3::Constant(sensor.sigma * sensor.sigma);
      received.set.detections.push_back(detection);
    }
    if (frame % sensor.every == 0) recording.observations.push_back(received);
  }
  return recording;
}

}  // namespace tern::calibrate
