// The audit of a flight on an estimate among voxels: plans keep the margin of the pose's error from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tools/audit/app/load_flight.h"
#include "tools/audit/audit.h"

namespace tern::audit {
namespace {

using testing::copy_log_with;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;

std::string good() { return testing::recorded_log("estimated"); }

/// Audits a copy of the flight's log in which the POSE_ERRORs are changed.
Audit audit_with(const std::function<bool(PoseError&)>& change) {
  const TempFolder folder;
  const std::string log = folder.file("changed.lcm");
  copy_log_with<PoseError>(good(), log, channels::kPoseError.name, change);
  return audit_flight(load_flight(log).value());
}

TEST(AuditMapMargin, HoldsForEachVoxelNearAPlan) {
  const FlightRecord record = load_flight(good()).value();
  const Audit audit = audit_flight(record);
  EXPECT_EQ(audit.check("certificates").verdict(), Verdict::Held) << to_text(audit, record);
  EXPECT_THAT(audit.check("certificates").summary, HasSubstr("with voxels"));
  EXPECT_EQ(audit.check("map").verdict(), Verdict::Held);
  const auto has_error = [](const auto& named) { return named.second.pose_error.has_value(); };
  EXPECT_GT(std::ranges::count_if(record.predictions, has_error), 100);
}

TEST(AuditMapMargin, IsMissedIfTheErrorWasLargerThanThePlannerWasTold) {
  const Audit audit = audit_with([](PoseError& error) {
    error.apart += 1.0;
    return true;
  });
  EXPECT_EQ(audit.check("certificates").verdict(), Verdict::Broken);
  EXPECT_THAT(audit.check("certificates").findings, Each(Field(&Finding::what, HasSubstr("with its margin of"))));
}

TEST(AuditMapMargin, IsNotJudgedForASetWhosePoseErrorIsMissing) {
  const Audit audit = audit_with([count = 0](PoseError&) mutable { return ++count < 40; });
  EXPECT_EQ(audit.check("certificates").verdict(), Verdict::Held);
  EXPECT_GT(audit.check("certificates").unchecked.at("plans whose predictions are not in the log"), 0);
}

}  // namespace
}  // namespace tern::audit
