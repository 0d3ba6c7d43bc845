// A digest of a world: tests compare two worlds, and the world of a seed with its recorded digest.
#pragma once

#include <cstdint>
#include <variant>

#include "core/base/digest.h"
#include "simulator/worlds/world.h"

namespace tern {

/// Computes one digest of the bytes of numbers.
struct Digester {
  std::uint64_t value = kDigestSeed;

  void operator()(double x) {
    const double canonical = x == 0.0 ? 0.0 : x;  // −0 and 0 are equal values
    value = digest({reinterpret_cast<const char*>(&canonical), sizeof canonical}, value);
  }
  void operator()(const Vec3& v) {
    for (int i = 0; i < 3; ++i) (*this)(v[i]);
  }
  void operator()(const StaticMotion&) {}
  void operator()(const TrefoilMotion& m) { (*this)(m.scale), (*this)(m.slowness), (*this)(m.phase); }
  void operator()(const WaveMotion& m) { (*this)(m.amplitude), (*this)(m.slowness), (*this)(m.phase); }
  void operator()(const LinearMotion& m) { (*this)(m.velocity), (*this)(m.from_s); }
  void operator()(const WaypointMotion& m) {
    for (const auto& [t, p] : m.points) (*this)(t), (*this)(p);
    (*this)(m.repeat ? 1.0 : 0.0), (*this)(m.vanish ? 1.0 : 0.0);
    if (m.vanish) (*this)(m.leave_out_within_m);
  }
  void operator()(const ObstacleSpec& o) {
    value = digest(o.name, value);
    (*this)(o.centre), (*this)(o.half_extents), (*this)(static_cast<double>(o.motion.index()));
    std::visit(*this, o.motion);
  }
};

/// Returns the digest of names, shapes and motions of all obstacles, in order. Equal worlds have equal digests.
inline std::uint64_t world_digest(const World& world) {
  Digester digester;
  for (const WorldObstacle& o : world.obstacles) digester(o.spec());
  return digester.value;
}

}  // namespace tern
