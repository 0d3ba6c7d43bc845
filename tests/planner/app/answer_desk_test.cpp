#include "planner/app/answer_desk.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/planner/app/answers.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kNow{50'000'000};

class AnswerDeskTest : public ::testing::Test {
 protected:
  [[nodiscard]] static HorizonRequest request(std::int64_t id, UTime t_s = kNow + Duration{75'000}) {
    HorizonRequest r = support::request_at(t_s, support::resting_at(Vec3(1, 2, 3), kNow - Duration{1'000'000}));
    r.id = id;
    r.header.name = {7, id};
    return r;
  }
  [[nodiscard]] static Plan plan_for(std::int64_t id, PlanOutcome outcome) {
    Plan plan;
    plan.request_id = id;
    plan.outcome = outcome;
    plan.trajectory = support::resting_at(Vec3(1, 2, 3), kNow);
    return plan;
  }
  [[nodiscard]] static PlanTiming timing_for(std::int64_t id) {
    PlanTiming timing;
    timing.request_id = id;
    return timing;
  }

  SharedClock clock_{kNow};
  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  Bus bus_{lcm_, clock_, 1};
  Answers answers_{lcm_, clock_};
  AnswerDesk desk_{bus_, 0xabcd};
};

TEST_F(AnswerDeskTest, TheWorkersAnswerGoesOutOnceWithTheConfigurationsName) {
  desk_.open(request(5), kNow);
  EXPECT_TRUE(desk_.answer(plan_for(5, PlanOutcome::Optimized), timing_for(5)));
  EXPECT_FALSE(desk_.answer(plan_for(5, PlanOutcome::SearchOnly), timing_for(5)));
  desk_.watch(kNow + Duration{1'000'000});
  answers_.hear();
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::Optimized);
  EXPECT_EQ(answers_.plans[0].inputs.configuration_hash, 0xabcdu);
  ASSERT_EQ(answers_.timings.size(), 1u);
  EXPECT_FALSE(answers_.timings[0].from_watchdog);
}

TEST_F(AnswerDeskTest, TheWatchdogAnswersBeforeTheDeadlineAndNotSooner) {
  const HorizonRequest asked = request(5);
  desk_.open(asked, kNow);
  ASSERT_TRUE(desk_.watch_time());
  EXPECT_EQ(*desk_.watch_time(), asked.deadline - kWatchdogLead);
  desk_.watch(asked.deadline - kWatchdogLead - Duration{1});
  answers_.hear();
  EXPECT_TRUE(answers_.plans.empty());
  desk_.watch(asked.deadline - kWatchdogLead);
  answers_.hear();
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::NoPlan);
  EXPECT_EQ(answers_.plans[0].reason, PlanReason::OutOfTime);
  EXPECT_EQ(answers_.plans[0].inputs.request, asked.header.name);
  ASSERT_EQ(answers_.timings.size(), 1u);
  EXPECT_TRUE(answers_.timings[0].from_watchdog);
  EXPECT_FALSE(desk_.watch_time());
  EXPECT_FALSE(desk_.answer(plan_for(5, PlanOutcome::Optimized), timing_for(5)));
  answers_.hear();
  EXPECT_EQ(answers_.plans.size(), 1u);
}

TEST_F(AnswerDeskTest, TheWatchdogSendsTheNewestImprovementAndSaysWhichItWas) {
  desk_.open(request(5), kNow);
  desk_.improve(plan_for(5, PlanOutcome::KeepCommitted));
  desk_.improve(plan_for(5, PlanOutcome::SearchOnly));
  desk_.improve(plan_for(4, PlanOutcome::Optimized));  // another request's
  desk_.watch(kNow + Duration{1'000'000});
  answers_.hear();
  ASSERT_EQ(answers_.plans.size(), 1u);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::SearchOnly);
  EXPECT_TRUE(answers_.plans[0].cuts.empty());
  EXPECT_EQ(answers_.plans[0].standing, 2);
}

TEST_F(AnswerDeskTest, AnOlderOpenRequestIsAnsweredWhenANewOneComes) {
  desk_.open(request(5), kNow);
  desk_.improve(plan_for(5, PlanOutcome::KeepCommitted));
  desk_.open(request(6), kNow + Duration{10'000});
  EXPECT_FALSE(desk_.answer(plan_for(5, PlanOutcome::Optimized), timing_for(5)));
  EXPECT_TRUE(desk_.answer(plan_for(6, PlanOutcome::Optimized), timing_for(6)));
  answers_.hear();
  const auto count = answers_.per_request();
  EXPECT_EQ(count.at(5), 1);
  EXPECT_EQ(count.at(6), 1);
  EXPECT_EQ(answers_.plans[0].outcome, PlanOutcome::KeepCommitted);
}

TEST_F(AnswerDeskTest, WhoeverIsFirstEveryRequestIsAnsweredExactlyOnce) {
  constexpr std::int64_t kRequests = 300;
  for (std::int64_t id = 1; id <= kRequests; ++id) {
    const HorizonRequest asked = request(id);
    desk_.open(asked, kNow);
    std::thread worker([&] {
      desk_.improve(plan_for(id, PlanOutcome::SearchOnly));
      (void)desk_.answer(plan_for(id, PlanOutcome::Optimized), timing_for(id));
    });
    desk_.watch(asked.deadline);
    worker.join();
    answers_.hear();
  }
  const auto count = answers_.per_request();
  EXPECT_EQ(count.size(), static_cast<std::size_t>(kRequests));
  for (const auto& [id, times] : count) EXPECT_EQ(times, 1) << "request " << id;
  EXPECT_EQ(answers_.timings.size(), answers_.plans.size());
}

}  // namespace
}  // namespace tern
