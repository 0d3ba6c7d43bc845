#include "simulator/worlds/blind_corner.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr double kMargin = 3.0;             // from start and goal to the walls, m
constexpr double kLeastShare = 6.0;         // of the corridor, per gap, m
constexpr double kGap = 1.5;                // width, m
constexpr double kThickness = 0.2;          // of walls, m
constexpr double kHalfHeight = 1.5;         // of walls and movers, m
constexpr double kHalfMover = 0.25;         // m
constexpr double kHidden = 0.3;             // free space between a waiting mover and wall, stub and the gap's edge, m
constexpr double kStub = 1.3;               // length of a stub, m
constexpr double kFirstStep = 0.5;          // earliest time at which somebody sets out, s
constexpr double kSlow = 2.5, kFast = 5.0;  // mean speeds of vehicles, m/s

struct Corridor {
  double y = 0.0, half_width = 0.0;  // m
};

/// One gap, the side on which somebody waits (±1), how fast they walk, and when they are in the corridor's middle.
struct Gap {
  double x = 0.0, side = 1.0;          // m
  double speed = 1.0, middle_s = 0.0;  // m/s, s
  [[nodiscard]] double before() const { return x - kGap / 2; }
  [[nodiscard]] double after() const { return x + kGap / 2; }
};

ObstacleSpec upright(double x_min, double x_max, double y_min, double y_max) {
  ObstacleSpec o;
  o.centre = Vec3((x_min + x_max) / 2, (y_min + y_max) / 2, kHalfHeight);
  o.half_extents = Vec3((x_max - x_min) / 2, (y_max - y_min) / 2, kHalfHeight);
  return o;
}

ObstacleSpec mover(const Corridor& corridor, const Gap& gap) {
  const double aside = corridor.half_width + kThickness + kHidden + kHalfMover;  // from the middle to where they wait
  const Vec3 waits(gap.before() - kHidden - kHalfMover, corridor.y + gap.side * aside, kHalfHeight);
  const Vec3 turns(gap.x, waits.y(), kHalfHeight);
  const Vec3 stays(gap.x, corridor.y - gap.side * aside, kHalfHeight);
  const double walk_s = (turns.x() - waits.x()) / gap.speed;
  const double half_crossing_s = aside / gap.speed;
  const double from_s = std::max(kFirstStep, gap.middle_s - half_crossing_s - walk_s);
  ObstacleSpec o;
  o.centre = waits;
  o.half_extents = Vec3(kHalfMover, kHalfMover, kHalfHeight);
  WaypointMotion motion;
  motion.points = {{from_s, waits}, {from_s + walk_s, turns}, {from_s + walk_s + 2 * half_crossing_s, stays}};
  o.motion = motion;
  return o;
}

/// A piece of wall across the way behind a waiting mover: it hides them from the gaps before.
ObstacleSpec stub(const Corridor& corridor, const Gap& gap) {
  const double x_max = gap.before() - 2 * kHidden - 2 * kHalfMover;
  const double inner = gap.side * (corridor.half_width + kThickness);
  const double outer = inner + gap.side * kStub;
  return upright(x_max - kThickness, x_max, corridor.y + std::min(inner, outer), corridor.y + std::max(inner, outer));
}

}  // namespace

Result<std::vector<ObstacleSpec>> draw_blind_corner(int gaps, std::uint64_t seed, const Vec3& start, const Vec3& goal) {
  const double first_x = start.x() + kMargin;
  const double last_x = goal.x() - kMargin;
  if (last_x - first_x < gaps * kLeastShare) {
    return fail(
        fmt::format("generator blind_corner: {} gaps need a goal at least {} m along x from the start; it is {}", gaps,
                    gaps * kLeastShare + 2 * kMargin, goal.x() - start.x()));
  }
  std::vector<ObstacleSpec> obstacles;
  if (gaps == 0) return obstacles;
  Rng rng(seed);
  const Corridor corridor{start.y(), rng.uniform(1.0, 3.0)};
  const double share = (last_x - first_x) / gaps;
  std::vector<Gap> drawn;
  for (int k = 0; k < gaps; ++k) {
    Gap gap;
    // A mover and its stub fit before the gap, within the gap's share.
    gap.x = first_x + k * share + rng.uniform(kLeastShare / 2, share - kLeastShare / 2 + kGap / 2);
    gap.side = rng.uniform() < 0.5 ? -1.0 : 1.0;
    gap.speed = rng.uniform(0.5, 2.0);
    gap.middle_s = rng.uniform((gap.x - start.x()) / kFast, (gap.x - start.x()) / kSlow);
    drawn.push_back(gap);
  }
  for (const Gap& gap : drawn) obstacles.push_back(mover(corridor, gap));
  for (const Gap& gap : drawn) obstacles.push_back(stub(corridor, gap));
  double from_x = first_x;
  for (std::size_t k = 0; k <= drawn.size(); ++k) {
    const double to_x = k < drawn.size() ? drawn[k].before() : last_x;
    const double inner = corridor.half_width, outer = inner + kThickness;
    obstacles.push_back(upright(from_x, to_x, corridor.y + inner, corridor.y + outer));
    obstacles.push_back(upright(from_x, to_x, corridor.y - outer, corridor.y - inner));
    if (k < drawn.size()) from_x = drawn[k].after();
  }
  return obstacles;
}

}  // namespace tern
