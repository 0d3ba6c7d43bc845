// Coverage of predictions is counted by class, horizon and confidence; implausible shares are broken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/splines/piecewise_cubic.h"
#include "core/world/alpha_share.h"
#include "tools/audit/audit.h"
#include "tools/audit/covering.h"
#include "tools/audit/pairing.h"
#include "tools/audit/plan_case.h"

namespace tern::audit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Pair;

constexpr double kHalf = 0.25, kAlpha = 0.1, kFlight = 12.0;
UTime at(double s) { return UTime{1'000'000} + Duration::from_seconds(s); }

/// Objects in a row, 5 m apart, which move along y at 1 m/s as predicted.
struct World {
  FlightRecord record;
  int things = 0;

  explicit World(int n) : things(n) {
    for (int k = 0; k <= 100 * static_cast<int>(kFlight); ++k) {
      UavState s;
      s.at = at(0.01 * k);
      record.states.push_back(s);
    }
    HorizonRequest request;
    request.header = {{1, 1}, at(0.0)};
    request.id = 1;
    request.t_s = at(0.075);
    request.deadline = at(0.07);
    record.requests.push_back(request);
    for (int id = 0; id < n; ++id) {
      auto& history = record.truth[id];
      history.moves = true;
      for (int k = 0; k <= 50 * static_cast<int>(kFlight); ++k) {
        history.samples.push_back({at(0.02 * k), place(id, 0.02 * k), Vec3::UnitY(), Vec3::Constant(kHalf)});
      }
    }
  }
  [[nodiscard]] static Vec3 place(std::int64_t id, double s) { return {5.0 * static_cast<double>(id), s, 1.0}; }

  /// The prediction of an object at `s` for the next two seconds.
  [[nodiscard]] static Track track(std::int64_t track_id, std::int64_t thing, double s) {
    Track track;
    track.id = track_id;
    track.kind = TrackKind::Estimated;
    track.half_extents = Vec3::Constant(kHalf);
    PowerCubic cubic = PowerCubic::Zero();
    cubic.col(2) = Vec3::UnitY();
    cubic.col(3) = place(thing, s);
    track.motion.start = at(s);
    track.motion.pieces.push_back({Duration::from_seconds(2.0), cubic});
    track.alpha.push_back(Vec3::Constant(kAlpha));
    track.shares.push_back(on_all_axes({0.8F, 0.6F, 0.4F, 0.2F}));
    track.top_speed = 5.0;
    return track;
  }

  /// Adds a set every 0.05 s in which each object has its track.
  void predict(std::int64_t first_id) {
    for (int k = 0; k < 20 * static_cast<int>(kFlight); ++k) {
      TrackSet set;
      set.header = {{2, k + 1}, at(0.05 * k)};
      set.made_at = at(0.05 * k);
      set.confidence = 0.99;
      for (int id = 0; id < things; ++id) set.tracks.push_back(track(first_id + id, id, 0.05 * k));
      record.predictions.emplace(set.header.name, set);
    }
  }

  /// Displaces the object by `off`, m, from s on for a time.
  void push(std::int64_t thing, double s, double length_s, double off) {
    for (auto& sample : record.truth[thing].samples) {
      if (sample.at >= at(s) && sample.at < at(s + length_s)) sample.p.x() += off;
    }
  }
  /// Adds another request, from `s` on.
  HorizonRequest ask(int sequence, double s) {
    HorizonRequest request = record.requests.front();
    request.header.name.sequence = sequence;
    request.t_s = at(s);
    record.requests.push_back(request);
    return request;
  }
  [[nodiscard]] std::pair<Audit, Check> audit() const {
    Audit audit;
    Check check = check_predictions(record, audit);
    return {audit, check};
  }
};

const CoverageShare& share(const Audit& audit, const std::string& what, const std::string& horizon,
                           double confidence = 0.99) {
  for (const CoverageShare& s : audit.shares) {
    if (s.what == what && s.horizon == horizon && s.confidence == confidence) return s;
  }
  throw std::out_of_range(what);
}

TEST(AuditedPredictions, ThatHoldAreKeptInEveryClassAndAtEveryLevel) {
  World world(20);
  world.predict(1'000);
  const auto [audit, check] = world.audit();
  EXPECT_EQ(check.verdict(), Verdict::Held);
  for (const CoverageShare& s : audit.shares) {
    EXPECT_EQ(s.covered, s.made) << s.what;
    EXPECT_EQ(s.interval.high, 1.0);
    EXPECT_NEAR(s.half_m, kAlpha, 1e-12);
  }
  EXPECT_EQ(share(audit, "old", "0.25").groups, 20);
  EXPECT_FALSE(to_text(audit.shares).empty());
}

TEST(AuditedPredictions, AreBrokenForAllTimesUpToTheHorizonThatReachAMiss) {
  World world(1);
  world.predict(1'000);
  // Outside between 6.00 and 6.02 s: one sample. Predictions made up to h before it miss up to h, at all levels.
  world.push(0, 6.0, 0.02, 0.5);
  const auto [audit, check] = world.audit();
  for (const auto& [horizon, length] :
       std::map<std::string, double>{{"0.25", 0.25}, {"0.5", 0.5}, {"1", 1.0}, {"2", 2.0}}) {
    const CoverageShare& s = share(audit, "old", horizon);
    EXPECT_EQ(s.made - s.covered, static_cast<int>(length / 0.05) + 1) << horizon;
  }
  EXPECT_EQ(check.verdict(), Verdict::Held) << "one thing of one flight says little of a probability";
}

TEST(AuditedPredictions, AreCountedAtEachLevelByTheAlphaOfThatLevel) {
  World world(1);
  world.predict(1'000);
  world.push(0, 0.0, kFlight + 1.0, 0.07);  // within α and its 0.8, not within its 0.6
  const auto [audit, check] = world.audit();
  for (const double kept : {0.99, 0.95}) EXPECT_EQ(share(audit, "old", "1", kept).share(), 1.0);
  for (const double broken : {0.9, 0.8, 0.6}) EXPECT_EQ(share(audit, "old", "1", broken).share(), 0.0);
}

TEST(AuditedPredictions, ThatCannotHaveKeptTheirPromiseFailTheFlight) {
  World world(30);
  world.predict(1'000);
  for (int id = 0; id < 30; ++id) world.push(id, 3.0 + 0.2 * id, 0.5, 0.5);  // each misses some 10 % of the time
  const auto [audit, check] = world.audit();
  EXPECT_EQ(check.verdict(), Verdict::Broken);
  EXPECT_TRUE(share(audit, "old", "0.5").is_refuted());
  EXPECT_THAT(check.findings.front().what, HasSubstr("predictions of class old"));
}

TEST(AuditedPredictions, OfFewBadObstaclesAmongManyAreNotCalledBroken) {
  World world(100);
  world.predict(1'000);
  world.push(7, 2.0, 8.0, 0.5);  ///< one of a hundred is missed nearly always: 0.99 of all predictions cover
  const auto [audit, check] = world.audit();
  EXPECT_LT(share(audit, "old", "1").share(), 1.0);
  EXPECT_EQ(check.verdict(), Verdict::Held);
}

TEST(AuditedPredictions, AreClassedByHowLongTheirTrackHasBeenInTheSets) {
  World world(1);
  world.predict(1'000);
  for (auto& [name, set] : world.record.predictions) {
    if (set.made_at < at(5.0)) set.tracks.clear();
  }
  const auto [audit, check] = world.audit();
  EXPECT_EQ(share(audit, "new", "1").made, 3);     // 0, 0.05, 0.1 s
  EXPECT_EQ(share(audit, "young", "1").made, 4);   // to 0.3 s
  EXPECT_EQ(share(audit, "grown", "1").made, 14);  // to 1 s
  EXPECT_GT(share(audit, "old", "1").made, 50);
  EXPECT_EQ(audit.moving_by_age[0][0].made, 1);
}

TEST(AuditedPredictions, OfWhatIsPredictedToStayAreAtRest) {
  World world(1);
  world.predict(1'000);
  for (auto& [name, set] : world.record.predictions) set.tracks[0].motion.pieces[0].coefficients.col(2).setZero();
  const auto [audit, check] = world.audit();
  EXPECT_GT(share(audit, "at rest", "0.25").made, 0);
  EXPECT_EQ(share(audit, "at rest", "0.25").share(), 0.0) << "it goes";
}

TEST(IntervalsOfParts, ContainABoxTogetherIfNoPointOfItIsLeft) {
  Rng rng(3);
  int together = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Box whole(Vec3::Zero(), Vec3::Ones());
    std::vector<Box> boxes;
    for (int k = 0; k < 4; ++k) {
      // Corners on a grid of thirds: cells of the grid are inside a box or outside of it.
      const auto corner = [&] { return std::floor(rng.uniform(-1.0, 5.0)) / 3.0; };
      const Vec3 a(corner(), corner(), corner()), b(corner(), corner(), corner());
      boxes.emplace_back(a.cwiseMin(b) - Vec3::Constant(0.2), a.cwiseMax(b) + Vec3::Constant(0.2));
    }
    bool is_left = false;  // by brute force: the points of a fine grid
    for (int i = 0; i <= 30; ++i) {
      for (int j = 0; j <= 30; ++j) {
        for (int k = 0; k <= 30 && !is_left; ++k) {
          const Vec3 p = Vec3(i, j, k) / 30.0;
          is_left = std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) { return box.contains(p); });
        }
      }
    }
    ASSERT_EQ(contain_together(boxes, whole), !is_left) << "trial " << trial;
    together += is_left ? 0 : 1;
  }
  EXPECT_GT(together, 100);
}

/// Turns an object's track into two: its halves along x.
void see_in_parts(World& world, int thing) {
  for (auto& [name, set] : world.record.predictions) {
    const auto whole = std::find_if(set.tracks.begin(), set.tracks.end(),
                                    [&](const Track& track) { return track.id == 1'000 + thing; });
    Track other = *whole;
    whole->half_extents.x() = other.half_extents.x() = 0.5 * kHalf;
    whole->motion.pieces[0].coefficients.col(3).x() -= 0.5 * kHalf;
    other.motion.pieces[0].coefficients.col(3).x() += 0.5 * kHalf;
    other.id = 2'000 + thing;
    set.tracks.push_back(other);
  }
}

TEST(AuditedPredictions, OfThePartsOfASeenObstacleCoverItTogether) {
  World world(2);
  world.predict(1'000);
  for (int k = 0; k < 20 * static_cast<int>(kFlight); ++k) {
    ObservationSet& parts = world.record.sightings.emplace_back();
    parts.at = at(0.05 * k);
    for (int id = 0; id < 2; ++id) {
      Detection part;
      part.position = World::place(id, 0.05 * k);
      part.half_extents = Vec3::Constant(kHalf);
      parts.detections.push_back(part);
    }
  }
  see_in_parts(world, 1);
  EXPECT_EQ(share(world.audit().first, "old", "1").share(), 1.0);
  world.record.sightings.clear();
  EXPECT_LT(share(world.audit().first, "old", "1").share(), 0.6) << "a detector's tracks are whole";
}

/// A detection of each object every 0.05 s, except of `hidden` from s on.
void observe(World& world, int hidden, double s) {
  for (int k = 0; k < 20 * static_cast<int>(kFlight); ++k) {
    ObservationSet set;
    set.at = at(0.05 * k);
    for (int id = 0; id < world.things; ++id) {
      if (id == hidden && 0.05 * k >= s) continue;
      Detection d;
      d.position = World::place(id, 0.05 * k);
      d.half_extents = Vec3::Constant(kHalf);
      set.detections.push_back(d);
    }
    world.record.observations.push_back(set);
  }
}

TEST(AuditedPredictions, OfWhatNoSensorSeesAreAClassOfTheirOwn) {
  World world(3);
  world.predict(1'000);
  observe(world, 1, 5.0);
  const auto [audit, check] = world.audit();
  const CoverageShare& unseen = share(audit, "unseen", "0.25");
  EXPECT_EQ(unseen.groups, 1);
  EXPECT_NEAR(static_cast<double>(unseen.made), 20.0 * (kFlight - 5.0 - 0.25 - 0.25), 2.0);
}

TEST(AuditedPredictions, OfATrackOutOfViewAreHeldAgainstTheObstacleThatItHad) {
  World world(2);
  world.predict(1'000);
  observe(world, 1, 5.0);
  world.push(1, 6.0, kFlight, 30.0);  ///< it goes far away, unseen
  const auto [audit, check] = world.audit();
  EXPECT_LT(share(audit, "unseen", "0.25").share(), 0.1);
  EXPECT_EQ(share(audit, "old", "0.25").share(), 1.0);
}

TEST(AuditedPredictions, OfASecondTrackOfAnObstacleAreNobodys) {
  World world(3);
  world.predict(1'000);
  for (auto& [name, set] : world.record.predictions) {
    Track ghost = set.tracks[1];
    ghost.id = 5'000;
    ghost.motion.pieces[0].coefficients.col(3).x() += 1.0;
    set.tracks.push_back(ghost);
  }
  const auto [audit, check] = world.audit();
  EXPECT_EQ(check.verdict(), Verdict::Held);
  EXPECT_EQ(share(audit, "old", "1").share(), 1.0);
  EXPECT_EQ(check.unchecked.begin()->second, 1);
}

/// A plan certified at this level, from the predictions made at 5 s.
Plan answer_to(const HorizonRequest& request, int level) {
  Plan plan;
  plan.outcome = PlanOutcome::Optimized;
  plan.inputs.request = request.header.name;
  plan.inputs.predictions = {2, 101};
  plan.level = level;
  plan.confidence = kConfidenceLevels[static_cast<std::size_t>(level)];
  plan.trajectory.start = request.t_s;
  return plan;
}

TEST(AuditedPredictions, OfPlansAreHeldAgainstWhatTheyClaim) {
  World world(2);
  world.predict(1'000);
  world.push(0, 0.0, kFlight + 1.0, 0.07);  ///< missed at 0.9, covered at 0.95
  for (const int level : {1, 2}) {
    const HorizonRequest request = world.ask(10 + level, 5.1);
    Plan plan = answer_to(request, level);
    plan.hold = Duration::from_seconds(1.0);
    plan.certificate = {{1'000, 0, 0, 1, {}}, {1'000, 1, 0, 1, {}}};
    world.record.plans.push_back(plan);
  }
  const auto [audit, check] = world.audit();
  EXPECT_EQ(audit.coverage.claims[1], (ClaimCount{1, 1})) << "the other track has no plane";
  EXPECT_EQ(audit.coverage.claims[2], (ClaimCount{1, 0}));
}

TEST(AuditedPredictions, OfPlansEndWhereTheyAreSure) {
  World world(2);
  world.predict(1'000);
  world.push(0, 5.6, kFlight, 0.07);  ///< missed at 0.9 from then on
  HorizonRequest request = world.record.requests.front();
  for (const Duration sure_for : {Duration{300'000}, kMaxSpan}) {
    ++request.header.name.sequence;
    request.t_s = at(5.1);
    world.record.requests.push_back(request);
    Plan plan = answer_to(request, 2);
    plan.sure_for = sure_for;
    plan.hold = Duration::from_seconds(1.0);
    plan.certificate = {{1'000, 0, 0, 1, {}}};
    world.record.plans.push_back(plan);
  }
  const auto [audit, check] = world.audit();
  EXPECT_EQ(audit.coverage.claims[2], (ClaimCount{2, 1}));
}

TEST(AuditedPredictions, OfPlansThatTheFlightsEndCutsOffCountUpToThere) {
  World world(2);
  world.predict(1'000);
  world.push(0, kFlight - 0.2, 1.0, 0.5);
  const HorizonRequest request = world.ask(10, kFlight - 0.5);
  Plan plan = answer_to(request, 0);
  plan.inputs.predictions = {2, 20 * static_cast<int>(kFlight) - 9};  // made at the request's time
  plan.hold = Duration::from_seconds(1.0);
  plan.certificate = {{1'000, 0, 0, 1, {}}, {1'001, 0, 0, 1, {}}};
  world.record.plans.push_back(plan);
  const auto [audit, check] = world.audit();
  EXPECT_EQ(audit.coverage.claims[0], (ClaimCount{2, 1}));
}

TEST(AuditedPredictions, OfPlansThatClaimNothingAreCountedApart) {
  World world(1);
  world.predict(1'000);
  world.record.plans.push_back(answer_to(world.record.requests.front(), 4));
  world.record.plans.back().confidence = 0.0;
  const auto [audit, check] = world.audit();
  EXPECT_EQ(audit.coverage.claims[4].made, 0);
  EXPECT_THAT(check.unchecked, Contains(Pair(HasSubstr("without a confidence"), 1)));
}

TEST(AuditedPredictions, AreCountedFromTheBeginAndAsOldAsTheyAreThen) {
  World world(1);
  world.predict(1'000);
  for (int k = 1; k <= 12; ++k) {  // 0.6 s before
    TrackSet set;
    set.header = {{2, -k}, at(-0.05 * k)};
    set.made_at = at(-0.05 * k);
    set.tracks.push_back(World::track(1'000, 0, -0.05 * k));
    world.record.predictions.emplace(set.header.name, set);
  }
  const auto [audit, check] = world.audit();
  EXPECT_EQ(share(audit, "grown", "0.25").made, 9);  // 0.6 to 1 s
  EXPECT_THROW((void)share(audit, "new", "0.25"), std::out_of_range);
}

TEST(AContact, IsLookedBackFrom) {
  World world(2);
  world.predict(1'000);
  for (auto& [name, set] : world.record.predictions) {
    std::erase_if(set.tracks, [&](const Track& t) { return t.id == 1'001 || set.made_at < at(5.0); });
  }
  world.push(0, 5.8, 1.0, 0.5);
  const HorizonRequest request = world.ask(10, 5.2);
  world.record.plans = {answer_to(request, 2), answer_to(request, 4)};
  world.record.plans.back().confidence = 0.0;
  const Contact contact = contact_at(world.record, at(6.0), 0);
  EXPECT_NEAR(contact.in_predictions_s.value(), 1.0, 1e-9);
  ASSERT_TRUE(contact.predicted[0] && contact.predicted[1] && contact.predicted[2]);
  for (const auto& prediction : contact.predicted) {
    EXPECT_NEAR(prediction->needed_m, 0.5, 1e-6);
    EXPECT_EQ(prediction->alpha_m, kAlpha);
    EXPECT_FALSE(prediction->covered);
  }
  EXPECT_EQ(contact.confidence.value(), 0.9) << "the last plan claims none";
  EXPECT_NEAR(contact.confident_s.value(), 0.8, 1e-9);
  EXPECT_THAT(to_text(contact, world.record), HasSubstr("alpha was 0.10 m, and 0.50 m were needed: missed"));
  const nlohmann::json json = to_json(contact, world.record);
  EXPECT_EQ(json["promised"].size(), 3U);
  EXPECT_EQ(json["promised"][0]["kept"], false);
  EXPECT_EQ(json["last_confidence"], 0.9);
  EXPECT_FALSE(to_json(contact_at(world.record, at(6.0), 1), world.record).contains("in_predictions_s"));
  EXPECT_FALSE(contact_at(world.record, at(5.9), 0).predicted[2]) << "it was in no set then";
  EXPECT_TRUE(contact_at(world.record, at(5.7), 0).predicted[0]->covered);
  EXPECT_THAT(to_text(contact_at(world.record, at(6.0), 1), world.record), HasSubstr("was not in PREDICTIONS"));
}

TEST(ClaimedAlpha, IsWhatThePlannerCounts) {
  Rng rng(1);
  for (int n = 0; n < 200; ++n) {
    Track track = World::track(1, 0, 5.0);
    track.motion.pieces.assign(6, {Duration{200'000}, track.motion.pieces.front().coefficients});
    track.alpha.clear();
    track.shares.clear();
    for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
      track.alpha.emplace_back(rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1));
      AlphaShares& shares = track.shares.emplace_back();
      for (auto& of_axes : shares) {
        for (float& share : of_axes) share = static_cast<float>(rng.uniform(0.1, 1));
      }
    }
    Plan plan;
    plan.level = static_cast<int>(rng.uniform(0, kLevels));
    plan.alpha_scale = rng.uniform(0.1, 1.0);
    plan.sure_for = n % 2 == 0 ? Duration{200'000 * (n % 8)} : Duration::from_seconds(rng.uniform(0.0, 2.0));
    const std::size_t last = track.motion.locate(at(5.0) + plan.sure_for).index;
    const std::vector<Vec3> claimed = counted_alpha(track, plan, at(5.0));
    for (std::size_t k = 0; k < claimed.size(); ++k) {
      const Vec3 counted = AlphaShare{plan.level, plan.alpha_scale, last}.of(track, k);
      EXPECT_LT((claimed[k] - counted).norm(), 1e-12) << n << " piece " << k;
    }
  }
}

}  // namespace
}  // namespace tern::audit
