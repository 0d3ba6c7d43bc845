// A vehicle that is blown out of its tube follows braking trajectories from measured states, which are no plans.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "messages/codec.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"
#include "tools/audit/audit.h"
#include "tools/audit/commitment.h"

namespace tern::audit {
namespace {

using testing::copy_log_with;
using ::testing::HasSubstr;

/// A quadrotor that meets a gust of 40 m/s among few obstacles.
class AuditOfStops : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempFolder;
    record_ = new FlightRecord(load_flight(good()).value());
  }
  static void TearDownTestSuite() {
    delete record_;
    delete folder_;
  }
  static std::string good() { return testing::recorded_log("gust"); }

  static std::vector<Commitment> stops() {
    std::vector<Commitment> found;
    for (const Commitments& own : commitments(*record_)) {
      for (const Commitment& c : own.list) {
        if (c.is_stop) found.push_back(c);
      }
    }
    return found;
  }
  /// Audits a log whose requests carry other braking trajectories.
  static Audit audit_with(const std::function<void(TimedSpline&)>& change) {
    const std::string log = folder_->file("changed.lcm");
    copy_log_with<HorizonRequest>(good(), log, channels::kHorizonRequest.name, [&](HorizonRequest& request) {
      for (const Commitment& stop : stops()) {
        if (!same(request.committed, stop.spline)) continue;
        change(request.committed);
        request.start = request.committed.spline().sample((request.t_s - request.committed.start).seconds());
      }
      return true;
    });
    return audit_flight(load_flight(log).value());
  }

  static TempFolder* folder_;
  static FlightRecord* record_;
};

TempFolder* AuditOfStops::folder_ = nullptr;
FlightRecord* AuditOfStops::record_ = nullptr;

TEST_F(AuditOfStops, FromMeasuredStatesSaysThatNoPlanCertifiedThem) {
  ASSERT_FALSE(stops().empty());
  const Audit audit = audit_flight(*record_);
  EXPECT_EQ(audit.check("commitment").verdict(), Verdict::Held) << to_text(audit, *record_);
  EXPECT_EQ(audit.check("continuity").verdict(), Verdict::Held);
  EXPECT_EQ(audit.check("tube").verdict(), Verdict::Broken) << "the vehicle did leave it";
  EXPECT_THAT(to_text(audit, *record_),
              HasSubstr("commitment: braking trajectories from a measured state, not certified by a plan"));
  EXPECT_THAT(to_text(audit, *record_), HasSubstr("continuity: braking trajectories from a measured state"));
}

TEST_F(AuditOfStops, ThatBeginElsewhereOrLeadOnAreBroken) {
  const Audit elsewhere = audit_with([](TimedSpline& stop) { stop.control_points.colwise() += Vec3(0.0, 1e-4, 0.0); });
  EXPECT_EQ(elsewhere.check("commitment").verdict(), Verdict::Broken);
  const Audit lead_on =
      audit_with([](TimedSpline& stop) { stop.control_points.rightCols<4>().colwise() += Vec3(0.0, 0.0, 0.5); });
  EXPECT_EQ(lead_on.check("commitment").verdict(), Verdict::Broken);
}

}  // namespace
}  // namespace tern::audit
