// The stated clearance holds between samples for any motion, compared with dense sampling of the true motions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/world/body_distance.h"
#include "flight_log/log_writer.h"
#include "messages/batching.h"
#include "messages/codec.h"
#include "simulator/worlds/declared_motions.h"
#include "simulator/worlds/world.h"
#include "tests/support/random_splines.h"
#include "tests/support/temp_folder.h"
#include "tests/support/voxel_maps.h"
#include "tools/audit/audit.h"

namespace tern::audit {
namespace {

using support::random_integer;
using support::random_vector;

const UTime kZero{1'700'000'000'000'000};
constexpr double kFlight = 2.0;  // s

/// A flown motion, moving obstacles, and the quality of the recording.
struct Case {
  World world;
  TimedSpline committed;  ///< according to the requests
  TimedSpline flown;      ///< the same, or that of a vehicle off its committed trajectory
  Body body;
  bool declared = true;
  double share_of_states = 1.0;
};

ObstacleSpec random_mover(Rng& rng) {
  ObstacleSpec o;
  o.centre = random_vector(rng, 3.0);
  o.half_extents = Vec3::Constant(0.05) + random_vector(rng, 0.4).cwiseAbs();
  const auto zigzag = [&](int points, double every_s) {
    WaypointMotion m;
    for (int k = 0; k < points; ++k) m.points.emplace_back(-0.3 + every_s * k, o.centre + random_vector(rng, 0.6));
    return m;
  };
  switch (random_integer(rng, 0, 5)) {
    case 0: o.motion = StaticMotion{}; break;
    case 1: o.motion = TrefoilMotion{random_vector(rng, 1.5), rng.uniform(0.3, 2.0), rng.uniform(0.0, 6.0)}; break;
    case 2: o.motion = WaveMotion{random_vector(rng, 2.0), rng.uniform(0.1, 1.0), rng.uniform(0.0, 6.0)}; break;
    case 3: o.motion = LinearMotion{random_vector(rng, 4.0), rng.uniform(0.0, 1.0)}; break;
    case 4: o.motion = zigzag(random_integer(rng, 20, 90), 0.0371); break;  // as a recording of people, but wilder
    default: o.motion = zigzag(random_integer(rng, 3, 12), rng.uniform(0.02, 0.5)); break;
  }
  return o;
}

TimedSpline random_flight(Rng& rng) {
  Points q(3, 13);
  q.col(0) = random_vector(rng, 2.0);
  for (int k = 1; k < q.cols(); ++k) q.col(k) = q.col(k - 1) + random_vector(rng, 0.8);
  q.rightCols<3>().colwise() = Vec3(q.col(10));
  return {kZero - Duration{100'000}, Duration{210'000}, q};
}

Case random_case(Rng& rng) {
  Case c;
  Scenario scenario;
  for (int k = random_integer(rng, 1, 5); k > 0; --k) scenario.world.obstacles.push_back(random_mover(rng));
  c.world = make_world(scenario, "").value();
  c.committed = random_flight(rng);
  c.flown = rng.uniform() < 0.5 ? c.committed : random_flight(rng);
  c.body.radius = rng.uniform(0.05, 0.3);
  c.declared = rng.uniform() < 0.8;
  c.share_of_states = rng.uniform() < 0.5 ? 1.0 : rng.uniform(0.1, 1.0);
  return c;
}

double largest_acceleration(const TimedSpline& spline) {
  double a = 0.0;
  for (double s = -0.1; s < kFlight + 0.5; s += 1e-3) {
    a = std::max(a, spline.sample(kZero + Duration::from_seconds(s)).a.cwiseAbs().maxCoeff());
  }
  return a * 1.001 + 1e-6;  ///< piecewise linear, so this bounds the difference between these times
}

/// Makes the log of a case, as logger and simulator would.
class Recording {
 public:
  Recording(const Case& c, Rng& rng, const std::string& path) : writer_(*LogWriter::open(path, 0)) {
    request(c, kZero, 1);
    request(c, kZero + Duration{1'000'000}, 2);
    for (Duration t{}; t.seconds() <= kFlight; t = t + Duration{10'000}) {
      if (t.us > 0 && rng.uniform() > c.share_of_states) continue;
      UavState state;
      state.at = kZero + t;
      state.motion = c.flown.sample(state.at);
      write(channels::kUavState.name, state, state.at);
      write(channels::kSetpoint.name, state, state.at);
    }
    for (Duration t{-33'333}; t.seconds() <= kFlight + 0.05; t = t + Duration{33'333}) truth(c, kZero + t);
    if (!c.declared) return;
    for (Duration t{-200'000}; t.seconds() <= kFlight; t = t + Duration{200'000}) declare(c, kZero + t);
  }
  ~Recording() { (void)writer_.flush(); }

 private:
  template <class T>
  void write(const char* channel, T message, UTime at) {
    message.header = {{1, ++sequences_[channel]}, at};
    writer_.append(channel, at.us, encode(message));
  }

  void request(const Case& c, UTime at, std::int64_t id) {
    HorizonRequest r;
    r.id = id;
    r.t_s = at + Duration{75'000};
    r.deadline = at + Duration{60'000};
    r.committed = c.committed;
    r.start = c.committed.sample(r.t_s);
    r.limits.v_max = Vec3::Constant(100.0);
    r.limits.a_max = Vec3::Constant(largest_acceleration(c.flown));
    r.limits.j_max = Vec3::Constant(INFINITY);
    r.body = c.body;
    r.flight_box = Box(Vec3::Constant(-100.0), Vec3::Constant(100.0));
    write(channels::kHorizonRequest.name, r, at);
  }

  void truth(const Case& c, UTime at) {
    ObstacleTruth truth;
    truth.batch.set = ++truths_;
    truth.at = at;
    truth.obstacles = true_obstacles(c.world, (at - kZero).seconds());
    for (const ObstacleTruth& batch : split_batches(truth)) write(channels::kObstacleTruth.name, batch, at);
  }

  void declare(const Case& c, UTime at) {
    TrackSet set = declare_motions(c.world, kZero, at - Duration{100'000}, at + Duration{1'000'000});
    set.batch.set = ++declarations_;
    set.made_at = at;
    for (const TrackSet& batch : split_batches(set)) write(channels::kDeclaredMotions.name, batch, at);
  }

  LogWriter writer_;
  std::map<std::string, std::int64_t> sequences_;
  std::int64_t truths_ = 0, declarations_ = 0;
};

/// The least clearance at instants 0.1 ms apart, and how much lower it may be between them.
struct Dense {
  double least = INFINITY, slack = 0.0;
};

Dense look_densely(const Case& c, UTime from, UTime to) {
  const BodyDistance distance(c.body);
  Dense dense;
  const Duration step{100};
  for (UTime t = from; t <= to; t = t + step) {
    const MotionSample vehicle = c.flown.sample(t);
    for (const WorldObstacle& o : c.world.obstacles) {
      const Vec3 p = vehicle.p - o.at((t - kZero).seconds()).p;
      dense.least = std::min(dense.least, distance(p, o.half_extents()));
      dense.slack = std::max(dense.slack, 0.5 * step.seconds() * (20.0 + o.bounds().speed.norm()));
    }
  }
  return dense;
}

RC_GTEST_PROP(AuditClearance, LiesWithinItsBoundsWhateverMovesBetweenTheSamples, (std::uint64_t seed)) {
  Rng rng(seed);
  const Case c = random_case(rng);
  const TempFolder folder;
  const std::string path = folder.file("flight.lcm");
  { Recording recording(c, rng, path); }
  const FlightRecord record = read_flight(path).value();
  const Audit audit = audit_flight(record);
  const Dense dense = look_densely(c, kZero, record.states.back().at);
  RC_ASSERT(audit.least.known);
  RC_LOG() << to_text(audit, record) << dense.least << "\n";
  RC_ASSERT(audit.least.high >= dense.least - dense.slack - 1e-9);
  if (audit.least.proven) RC_ASSERT(audit.least.low <= dense.least + 1e-9);
  if (audit.check("clearance").broken > 0) RC_ASSERT(dense.least < 0.0);
}

/// A map with some occupied voxels about the flight.
VoxelMap random_walls(Rng& rng) {
  VoxelMap map = support::free_map({20, 20, 20}, 0.4, Vec3(-4, -4, -4));
  support::sprinkle(map, rng, 0.003, VoxelLabel::Occupied);
  map.labels.front() = VoxelLabel::Occupied;
  map.version = map.compute_version();
  return map;
}

struct MapCase {
  FlightRecord record;
  Audit audit;
  Dense dense;  // by single voxels
};
MapCase flown_among_walls(std::uint64_t seed) {
  Rng rng(seed);
  Case c = random_case(rng);
  const TempFolder folder;
  const std::string path = folder.file("flight.lcm");
  { Recording recording(c, rng, path); }
  MapCase made;
  made.record = read_flight(path).value();
  const VoxelMap map = random_walls(rng);
  made.record.maps[map.version] = map;
  made.audit = audit_flight(made.record);
  Scenario scenario;
  for (std::int64_t k = 0; k < map.grid.voxels(); ++k) {
    if (map.labels[static_cast<std::size_t>(k)] != VoxelLabel::Occupied) continue;
    ObstacleSpec voxel;
    voxel.centre = map.grid.centre(map.grid.cell(k));
    voxel.half_extents = Vec3::Constant(0.2);
    scenario.world.obstacles.push_back(voxel);
  }
  c.world = make_world(scenario, "").value();
  made.dense = look_densely(c, kZero, made.record.states.back().at);
  return made;
}

RC_GTEST_PROP(AuditMap, ClearanceOfTheMapLiesWithinItsBounds, (std::uint64_t seed)) {
  const auto [record, audit, dense] = flown_among_walls(seed);
  RC_LOG() << to_text(audit, record) << dense.least << "\n";
  RC_ASSERT(audit.least_of_map.known);
  // Voxels that touch are one box: an overlap is deeper in it.
  if (dense.least > 0.0) RC_ASSERT(audit.least_of_map.high >= dense.least - dense.slack - 1e-9);
  if (audit.least_of_map.proven) RC_ASSERT(audit.least_of_map.low <= dense.least + 1e-9);
  if (audit.check("map").broken > 0) RC_ASSERT(dense.least < 0.0);
}

TEST(AuditMap, TheDeepestOverlapCountsWhereTheBodyIsDeepInTwoWalls) {
  for (const std::uint64_t seed : {28ULL, 14'669'610ULL, 59'066'242'470'765ULL}) {
    const MapCase made = flown_among_walls(seed);
    EXPECT_LT(made.dense.least, 0.0);
    EXPECT_LE(made.audit.least_of_map.low, made.dense.least + 1e-9) << "seed " << seed;
  }
}

TEST(AuditMap, IsNotJudgedWhereItChangedInFlight) {
  Rng rng(1);
  const TempFolder folder;
  const std::string path = folder.file("flight.lcm");
  { Recording recording(random_case(rng), rng, path); }
  FlightRecord record = read_flight(path).value();
  for (int k = 0; k < 2; ++k) {
    const VoxelMap map = random_walls(rng);
    record.maps[map.version] = map;
  }
  const Audit audit = audit_flight(record);
  EXPECT_EQ(audit.check("map").verdict(), Verdict::NotChecked);
  EXPECT_FALSE(audit.least_of_map.known);
}

TEST(AuditMap, ACollisionWithItDoesNotContradictTheClearanceOfObstacles) {
  Rng rng(3);
  Case c = random_case(rng);
  c.flown = c.committed;
  c.share_of_states = 1.0;
  const TempFolder folder;
  const std::string path = folder.file("flight.lcm");
  { Recording recording(c, rng, path); }
  FlightRecord record = read_flight(path).value();
  VoxelMap map = support::free_map({20, 20, 20}, 0.4, Vec3(-4, -4, -4));
  const Vec3 at = record.states[record.states.size() / 2].motion.p;
  const Eigen::Vector3i cell = map.grid.cell_of(at).cwiseMax(0).cwiseMin(19);
  support::paint(map, cell, cell, VoxelLabel::Occupied);
  record.maps[map.version] = map;
  FlightResult result;
  result.outcome = FlightOutcome::Collision;
  result.header.utime = record.states.back().at;
  result.flight_time_s = kFlight;
  result.min_map_clearance_m = -0.01;
  record.results.push_back(result);
  const Audit audit = audit_flight(record);
  EXPECT_EQ(audit.check("map").verdict(), Verdict::Broken);
  EXPECT_EQ(audit.collision, Collision::Agrees);
}

/// The property above would also hold if nothing were ever proven; this test excludes that.
TEST(AuditClearance, OfWhatIsDeclaredAndFlownAsCommittedIsProvenToTheDeclaredAlpha) {
  int proven = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Case c = random_case(rng);
    c.declared = true;
    c.flown = c.committed;
    c.share_of_states = 0.3;
    const TempFolder folder;
    const std::string path = folder.file("flight.lcm");
    { Recording recording(c, rng, path); }
    const Audit audit = audit_flight(read_flight(path).value());
    ASSERT_TRUE(audit.least.proven) << seed;
    EXPECT_LE(audit.least.high - audit.least.low, 2.0 * std::sqrt(3.0) * kFitError + 2e-3) << seed;
    ++proven;
  }
  EXPECT_EQ(proven, 20);
}

/// An obstacle that exists from `first` to `last`, s, far from the vehicle.
ObstacleSpec passer(double first, double last) {
  ObstacleSpec o;
  o.centre = Vec3(50.0, 0.0, 0.0);
  o.half_extents = Vec3::Constant(0.3);
  WaypointMotion m;
  m.vanish = true;
  for (int k = 0; k <= 10; ++k)
    m.points.emplace_back(first + 0.1 * k * (last - first), o.centre + Vec3(0.05 * k, 0.0, 0.0));
  o.motion = m;
  return o;
}

/// Regression: the audit of `crowd` counted an obstacle of the second after the flight.
TEST(AuditClearance, CountsTheObstaclesThatWereThereDuringTheFlightAndNoOthers) {
  Rng rng(7);
  Case c = random_case(rng);
  c.declared = false;
  c.flown = c.committed;
  c.share_of_states = 1.0;
  Scenario scenario;
  for (const auto& [first, last] : {std::pair{-0.1, 2.5}, {0.5, 1.0}, {1.7, 2.5}}) {
    scenario.world.obstacles.push_back(passer(first, last));
  }
  c.world = make_world(scenario, "").value();
  const TempFolder folder;
  const std::string path = folder.file("flight.lcm");
  { Recording recording(c, rng, path); }
  FlightRecord record = read_flight(path).value();
  FlightResult result;
  result.header = {{1, 1}, kZero + Duration::from_seconds(1.5)};
  result.outcome = FlightOutcome::Timeout;
  result.flight_time_s = 1.5;
  result.obstacles = 2;
  record.results = {result};
  const Audit audit = audit_flight(record);
  EXPECT_EQ(audit.obstacle_count.fewest, 2);
  EXPECT_EQ(audit.obstacle_count.most, 2);
  EXPECT_THAT(audit.check("clearance").summary, ::testing::EndsWith("; 2 obstacles"));

  const auto says = [&](std::int64_t obstacles) {
    record.results[0].obstacles = obstacles;
    const Audit other = audit_flight(record);
    for (const Finding& f : other.check("result").findings) {
      if (f.what.find("obstacles") != std::string::npos) return f.what;
    }
    return std::string();
  };
  EXPECT_EQ(says(2), "");
  EXPECT_EQ(says(3), "FLIGHT_RESULT says 3 obstacles, recomputed 2 to 2");
}

}  // namespace
}  // namespace tern::audit
