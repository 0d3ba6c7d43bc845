#include "simulator/worlds/generators.h"

#include <fmt/format.h>

#include <numbers>

#include "core/base/random.h"
#include "core/scenario/step_aside.h"
#include "simulator/worlds/blind_corner.h"
#include "simulator/worlds/obstacle.h"

namespace tern {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr int kMaxCount = 100'000;
constexpr int kMaxRedraws = 1000;
constexpr double kStartSample = 0.01;  // s
constexpr int kPeriodSamples = 256;

enum class Role { Mover, Pillar, BeamAlongY, BeamAlongX };

/// Integer arithmetic: 0.65 N in doubles may fall short of an integer.
Role role_of(int index, int count) {
  const int movers = count * 65 / 100;
  const int pillars = (count - movers) * 35 / 100;
  const int beams = count - movers - pillars;
  if (index < movers) return Role::Mover;
  if (index < movers + pillars) return Role::Pillar;
  return index < movers + pillars + beams / 2 ? Role::BeamAlongY : Role::BeamAlongX;
}

Vec3 draw_in(Rng& rng, const Box& box) {
  const double x = rng.uniform(box.min().x(), box.max().x());
  const double y = rng.uniform(box.min().y(), box.max().y());
  const double z = rng.uniform(box.min().z(), box.max().z());
  return {x, y, z};
}

Vec3 draw_at_height(Rng& rng, const Box& box, double z) {
  const double x = rng.uniform(box.min().x(), box.max().x());
  const double y = rng.uniform(box.min().y(), box.max().y());
  return {x, y, z};
}

ObstacleSpec unit_trefoil(Rng& rng, const Box& range) {
  ObstacleSpec o;
  o.centre = draw_in(rng, range);
  o.half_extents = Vec3::Constant(0.4);
  o.motion = TrefoilMotion{Vec3::Ones(), 1.1, rng.uniform(-kTwoPi, kTwoPi)};
  return o;
}

ObstacleSpec draw_paper(Rng& rng, Role role) {
  const Box range(Vec3(2, -2, 0), Vec3(72, 2, 4));
  if (role == Role::Mover) return unit_trefoil(rng, range);
  ObstacleSpec o;
  o.centre = draw_at_height(rng, range, 2.0);
  o.half_extents = Vec3(0.2, 0.2, 4.0);
  return o;
}

ObstacleSpec draw_mader(Rng& rng, Role role) {
  if (role == Role::Mover) return unit_trefoil(rng, Box(Vec3(2, -3, 1), Vec3(75, 3, 2)));
  const Box range(Vec3(1, -4, 0), Vec3(76, 4, 3));
  const bool pillar = role == Role::Pillar;
  ObstacleSpec o;
  o.centre = pillar ? draw_at_height(rng, range, 2.0) : draw_in(rng, range);
  o.half_extents = pillar ? Vec3(0.2, 0.2, 2.0) : Vec3(0.2, 4.0, 0.2);
  o.motion = WaveMotion{Vec3(0, 0, -1), 1.0, rng.uniform(-kTwoPi, kTwoPi)};
  return o;
}

ObstacleSpec draw_sando(Rng& rng, Role role) {
  const Box range(Vec3(5, -6, 0.5), Vec3(100, 6, 4.5));
  ObstacleSpec o;
  if (role == Role::Mover) {
    o.centre = draw_in(rng, range);
    o.half_extents = Vec3::Constant(0.4);
    const double kx = rng.uniform(2.0, 4.0) / 6.0;
    const double ky = rng.uniform(2.0, 4.0) / 5.0;
    const double kz = rng.uniform(2.0, 4.0) / 2.0;
    const double slowness = rng.uniform(4.0, 6.0);
    o.motion = TrefoilMotion{Vec3(kx, ky, kz), slowness, rng.uniform(0.0, 3.0)};
    return o;
  }
  o.centre = role == Role::Pillar ? draw_at_height(rng, range, 2.0) : draw_in(rng, range);
  o.half_extents = role == Role::Pillar       ? Vec3(0.2, 0.2, 2.0)
                   : role == Role::BeamAlongY ? Vec3(0.2, 2.0, 0.2)
                                              : Vec3(2.0, 0.2, 0.2);
  return o;
}

using Draw = ObstacleSpec (*)(Rng&, Role);

Draw find_generator(const std::string& name) {
  if (name == "paper_corridor" || name == "paper_attract" || name == "paper_repel" || name == "corridor_demo") {
    return draw_paper;
  }
  if (name == "mader_corridor") return draw_mader;
  if (name == "sando_forest") return draw_sando;
  return nullptr;
}

/// One round of the motion, s; 0: static.
double period_of(const ObstacleSpec& o) {
  if (const auto* m = std::get_if<TrefoilMotion>(&o.motion)) return kTwoPi * m->slowness;
  if (const auto* m = std::get_if<WaveMotion>(&o.motion)) return kTwoPi * m->slowness;
  return 0.0;
}

bool refused(const ObstacleSpec& o, const Vec3& start, const Vec3& goal) {
  const auto distance = [&](const Vec3& p, double t) {
    return distance_to_box(p, motion_state(o, t).p, o.half_extents);
  };
  const double period = period_of(o);
  if (period == 0.0) return distance(start, 0.0) < kStartClearance || distance(goal, 0.0) < kEndClearance;
  for (int i = 0; i * kStartSample <= kStartQuiet; ++i) {
    if (distance(start, i * kStartSample) < kStartClearance) return true;
  }
  for (int i = 0; i < kPeriodSamples; ++i) {
    if (distance(goal, period * i / kPeriodSamples) >= kEndClearance) return false;
  }
  return true;
}

}  // namespace

Result<GeneratedObstacles> generate(const std::string& generator, int count, std::uint64_t seed, const Vec3& start,
                                    const Vec3& goal, std::optional<double> slowness) {
  if (generator == "step_aside") return GeneratedObstacles{draw_step_aside(seed, start).movers, 0};
  if (count < 0 || count > kMaxCount) return fail(fmt::format("count {}, not in [0, {}]", count, kMaxCount));
  if (generator == "blind_corner") {
    auto drawn = draw_blind_corner(count, seed, start, goal);
    if (!drawn) return tl::unexpected(drawn.error());
    return GeneratedObstacles{std::move(*drawn), 0};
  }
  const Draw draw = find_generator(generator);
  if (draw == nullptr) {
    return fail(
        fmt::format("unknown generator '{}': paper_corridor, paper_attract, paper_repel, corridor_demo, "
                    "mader_corridor, sando_forest, step_aside, blind_corner or none",
                    generator));
  }
  GeneratedObstacles made;
  made.obstacles.reserve(static_cast<std::size_t>(count));
  Rng rng(seed);
  const auto draw_next = [&](int i) {
    ObstacleSpec o = draw(rng, role_of(i, count));
    if (auto* trefoil = std::get_if<TrefoilMotion>(&o.motion); trefoil != nullptr && slowness)
      trefoil->slowness = *slowness;
    return o;
  };
  for (int i = 0; i < count; ++i) {
    ObstacleSpec o = draw_next(i);
    for (int again = 0; refused(o, start, goal); ++again, ++made.redrawn) {
      if (again == kMaxRedraws) {
        return fail(fmt::format("generator {}, seed {}: no place for obstacle {} clear of start and goal in {} draws",
                                generator, seed, i, kMaxRedraws));
      }
      o = draw_next(i);
    }
    made.obstacles.push_back(std::move(o));
  }
  return made;
}

}  // namespace tern
