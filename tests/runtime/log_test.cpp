// The lines of the log.
#include "runtime/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tern {
namespace {

TEST(Log, WritesTimeProcessLevelAndText) {
  log::start("tern-here", "info");
  testing::internal::CaptureStderr();
  log::info("{} of {:.1f} m", 3, 0.25);
  log::write(log::Level::Error, "{}", std::string("{} stays as it is"));
  log::flush();
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::MatchesRegex("[0-9:]+.[0-9]+ tern-here info: 3 of 0.2 m\n"
                                    "[0-9:]+.[0-9]+ tern-here error: \\{\\} stays as it is\n"));
}

TEST(Log, LeavesOutLinesBelowItsLevel) {
  log::start("tern-here", "warning");
  testing::internal::CaptureStderr();
  log::info("not asked for");
  log::warn("asked for");
  log::flush();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::MatchesRegex(".* warning: asked for\n"));
}

}  // namespace
}  // namespace tern
