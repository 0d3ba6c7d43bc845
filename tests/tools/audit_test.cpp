// The audit of a recorded flight holds. If one thing is broken in its log, the audit finds that thing and no other.
#include "tools/audit/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "messages/codec.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"

namespace tern::audit {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::copy_log_with;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsSubsetOf;
using ::testing::Not;

/// A short flight among movers, past a region, recorded once for all tests (tests/flights).
class AuditedFlight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    record_ = new FlightRecord(load_flight(good()).value());
  }
  static void TearDownTestSuite() {
    delete record_;
    delete folder_;
  }

  static std::string good() { return testing::recorded_log("demo"); }

  /// Copies the log with a changed channel; messages for which `change` returns false are left out.
  template <class T>
  Audit audit_with(const char* channel, const std::function<bool(T&)>& change) {
    const std::string log = folder_->file(std::string("changed") + std::to_string(++copies_) + ".lcm");
    copy_log_with<T>(good(), log, channel, change);
    changed_ = load_flight(log).value();
    return audit_flight(changed_);
  }

  static std::vector<std::string> broken(const Audit& audit) {
    std::vector<std::string> names;
    for (const Check& c : audit.checks) {
      if (c.verdict() == Verdict::Broken) names.push_back(c.name);
    }
    return names;
  }

  /// Returns a plan with planes that was flown for long.
  static const Plan& plan_with_planes() {
    for (const Plan& plan : record_->plans) {
      if (plan.outcome == PlanOutcome::Optimized && !plan.certificate.empty()) return plan;
    }
    throw std::runtime_error("no plan with planes");
  }

  static TempFolder* folder_;
  static FlightRecord* record_;
  static inline int copies_ = 0;
  FlightRecord changed_;
};

TempFolder* AuditedFlight::folder_ = nullptr;
FlightRecord* AuditedFlight::record_ = nullptr;

TEST_F(AuditedFlight, HoldsAndLeavesNothingUnchecked) {
  const Audit audit = audit_flight(*record_);
  EXPECT_EQ(audit.verdict(), Verdict::Held) << to_text(audit, *record_);
  EXPECT_THAT(audit.missing, ElementsAre());
  for (const Check& check : audit.checks) {
    EXPECT_EQ(check.verdict(), Verdict::Held) << check.name;
    EXPECT_TRUE(check.unchecked.empty()) << check.name << ": " << check.unchecked.begin()->first;
  }
  EXPECT_GT(audit.check("certificates").measures[1].second, 0.0) << "planes";
}

TEST_F(AuditedFlight, WithAShiftedPlaneNamesItsObstacleAndRequest) {
  const std::int64_t request = plan_with_planes().request_id;
  const std::int64_t obstacle = plan_with_planes().certificate[0].track;
  for (const double shift : {3.0, -3.0}) {
    const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
      if (plan.request_id == request) plan.certificate[0].plane.d += shift;
      return true;
    });
    EXPECT_THAT(broken(audit), ElementsAre("certificates"));
    EXPECT_THAT(audit.check("certificates").findings,
                Each(AllOf(Field(&Finding::request, request), Field(&Finding::obstacle, obstacle))));
  }
}

TEST_F(AuditedFlight, WithPlanesLeftOutNamesThePairsThatNothingSeparates) {
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
    plan.certificate.clear();
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("certificates"));
  EXPECT_THAT(audit.check("certificates").findings,
              Each(Field(&Finding::what, HasSubstr("neither a plane nor a box separates obstacle"))));
}

TEST_F(AuditedFlight, WithATamperedControlPointNamesThatPlan) {
  const Plan& flown = plan_with_planes();
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
    if (plan.request_id == flown.request_id) plan.trajectory.control_points.col(4).z() += 1.0;
    return true;
  });
  EXPECT_THAT(broken(audit), IsSubsetOf({"limits", "commitment", "certificates"}));
  EXPECT_EQ(audit.check("limits").verdict(), Verdict::Broken);
  EXPECT_EQ(audit.check("commitment").verdict(), Verdict::Broken) << "what was flown is not what was planned";
  for (const Check& check : audit.checks) {
    for (const Finding& f : check.findings)
      EXPECT_TRUE(f.request == flown.request_id || f.at == flown.trajectory.start);
  }
}

TEST_F(AuditedFlight, OfAMultirotorThatCannotFlyItNamesThrustTiltAndBodyRate) {
  const Audit audit = audit_with<HorizonRequest>(channels::kHorizonRequest.name, [&](HorizonRequest& request) {
    request.limits.dynamics = Dynamics{9.0, 10.5, 1.0, 1.0};
    return true;
  });
  EXPECT_THAT(broken(audit), Contains("limits"));
  for (const char* what : {"thrust is", "tilt is", "body rate is"}) {
    EXPECT_THAT(audit.check("limits").findings, Contains(Field(&Finding::what, HasSubstr(what))));
  }
}

TEST_F(AuditedFlight, WithATrajectoryThatDoesNotJoinNamesTheSplice) {
  const std::int64_t request = plan_with_planes().request_id;
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
    if (plan.request_id == request) plan.trajectory.control_points.col(0).x() += 1e-5;
    return true;
  });
  EXPECT_EQ(audit.check("continuity").verdict(), Verdict::Broken);
  EXPECT_THAT(audit.check("continuity").findings, Each(Field(&Finding::request, request)));
}

TEST_F(AuditedFlight, WithAnObstacleMovedIntoTheWayNamesThatObstacle) {
  const UavState middle = record_->states[record_->states.size() / 2];
  const std::int64_t obstacle = audit_flight(*record_).clearance[200].obstacle;
  const Audit audit = audit_with<ObstacleTruth>(channels::kObstacleTruth.name, [&](ObstacleTruth& truth) {
    for (TrueObstacle& o : truth.obstacles) {
      if (o.id == obstacle && std::abs((truth.at - middle.at).seconds()) < 0.2) o.position = middle.motion.p;
    }
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("clearance", "predictions", "result"));
  EXPECT_THAT(audit.check("clearance").findings, ElementsAre(Field(&Finding::obstacle, obstacle)));
  EXPECT_THAT(audit.check("predictions").findings, ElementsAre(Field(&Finding::obstacle, obstacle)));
}

TEST_F(AuditedFlight, WithADelayedAnswerNamesThatRequest) {
  const std::int64_t request = plan_with_planes().request_id;
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
    if (plan.request_id == request) plan.header.utime = plan.header.utime + Duration{80'000};
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("answers"));
  EXPECT_THAT(
      audit.check("answers").findings,
      ElementsAre(AllOf(Field(&Finding::request, request), Field(&Finding::what, HasSubstr("after its deadline")))));
}

TEST_F(AuditedFlight, WithAShrunkAlphaNamesTheObstacleThatLeavesIt) {
  std::int64_t obstacle = kNoObstacle;
  const Audit audit = audit_with<TrackSet>(channels::kPredictions.name, [&](TrackSet& set) {
    for (Track& track : set.tracks) {
      if (track.kind == TrackKind::Static) continue;
      if (obstacle == kNoObstacle) obstacle = track.id;
      for (Vec3& alpha : track.alpha) {
        if (track.id == obstacle) alpha.setZero();
      }
    }
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("predictions"));
  EXPECT_THAT(audit.check("predictions").findings, ElementsAre(Field(&Finding::obstacle, obstacle)));
}

TEST_F(AuditedFlight, WithHoldsThatPromiseMuchNamesWhoMayReachTheEnd) {
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) {
    plan.hold = Duration{4'000'000};
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("holds"));
}

TEST_F(AuditedFlight, WithASetpointOffTheTrajectoryNamesItsInstant) {
  const UTime at = record_->setpoints[300].at;
  const Audit audit = audit_with<UavState>(channels::kSetpoint.name, [&](UavState& state) {
    if (state.at == at) state.motion.p.x() += 1e-4;
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("commitment", "tube"));
  for (const char* check : {"commitment", "tube"}) {
    EXPECT_THAT(audit.check(check).findings, ElementsAre(Field(&Finding::at, at))) << check;
  }
}

TEST_F(AuditedFlight, WithAStateBeyondALimitNamesTheLimit) {
  const UTime at = record_->states[300].at;
  const Audit audit = audit_with<UavState>(channels::kVehicleTruth.name, [&](UavState& state) {
    if (state.at == at) state.motion.a.z() = 10.1;
    return true;
  });
  EXPECT_THAT(broken(audit), ElementsAre("limits"));
  EXPECT_THAT(audit.check("limits").findings, ElementsAre(Field(&Finding::what, HasSubstr("acceleration z 10.1"))));
}

TEST_F(AuditedFlight, WithARefereeThatErrsNamesTheMeasure) {
  const auto audit_result = [&](const std::function<void(FlightResult&)>& change) {
    return audit_with<FlightResult>(channels::kFlightResult.name, [&](FlightResult& result) {
      change(result);
      return true;
    });
  };
  EXPECT_THAT(broken(audit_result([](FlightResult& r) { r.exposure.at(0).metres += 1.0; })), ElementsAre("exposure"));
  EXPECT_THAT(broken(audit_result([](FlightResult& r) { r.min_clearance_m += 0.01; })), ElementsAre("result"));
  EXPECT_THAT(broken(audit_result([](FlightResult& r) { r.path_length_m += 0.2; })), ElementsAre("result"));
}

TEST_F(AuditedFlight, WithAnAnswerTakenAwaySaysThatItWasLostAndBreaksNothing) {
  const std::int64_t request = plan_with_planes().request_id;
  const Audit audit = audit_with<Plan>(channels::kPlan.name, [&](Plan& plan) { return plan.request_id != request; });
  EXPECT_THAT(broken(audit), ElementsAre());
  EXPECT_THAT(audit.missing, ElementsAre("PLAN: 1 messages lost, as the sequence numbers show"));
  EXPECT_EQ(audit.check("answers").unchecked.size(), 1U);
  EXPECT_EQ(audit.check("commitment").unchecked.size(), 1U);
}

TEST_F(AuditedFlight, WithoutPredictionsSaysWhatCouldNotBeChecked) {
  const Audit audit = audit_with<TrackSet>(channels::kPredictions.name, [](TrackSet&) { return false; });
  EXPECT_THAT(broken(audit), ElementsAre());
  EXPECT_EQ(audit.check("certificates").verdict(), Verdict::NotChecked);
  EXPECT_EQ(audit.check("predictions").verdict(), Verdict::NotChecked);
  EXPECT_THAT(to_text(audit, changed_), HasSubstr("no PREDICTIONS"));
  EXPECT_THAT(to_text(audit, changed_), Not(HasSubstr("Nothing was left unchecked")));
}

int run_program(const std::string& arguments) {
  return WEXITSTATUS(std::system((std::string(TERN_AUDIT_PROGRAM) + " " + arguments + " >/dev/null 2>&1").c_str()));
}

TEST_F(AuditedFlight, ProgramSaysByItsExitCodeWhetherItHeld) {
  const std::string json = folder_->file("audit.json");
  EXPECT_EQ(run_program(good() + " --json " + json), 0);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(json))["verdict"], "held");
  const std::string late = folder_->file("late.lcm");
  copy_log_with<Plan>(good(), late, channels::kPlan.name, [](Plan& plan) {
    plan.header.utime = plan.header.utime + Duration{80'000};
    return true;
  });
  EXPECT_EQ(run_program(late + " --json " + json), 1);
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(json))["verdict"], "broken");
  EXPECT_EQ(run_program(folder_->file("nothing.lcm")), 2);
  EXPECT_EQ(run_program(""), 2);
  std::ofstream(folder_->file("empty.lcm")) << "no event";
  EXPECT_EQ(run_program(folder_->file("empty.lcm")), 2);
}

}  // namespace
}  // namespace tern::audit
