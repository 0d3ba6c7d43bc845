#include "planner/app/unseen_desk.h"

#include <gtest/gtest.h>

#include "core/world/body.h"
#include "planner/app/answer_desk.h"
#include "tests/planner/app/answers.h"
#include "tests/support/corridor_frames.h"
#include "tests/support/planner_worlds.h"

namespace tern {
namespace {

using namespace support;

constexpr UTime kNow{50'000'000};
constexpr UTime kStart = kNow + Duration{75'000};
const Vec3 kHome(0, 0, 1);

/// A lidar at home that sees nothing: only the ball of take-off is clear of unseen movers.
class UnseenDeskTest : public ::testing::Test {
 protected:
  UnseenDeskTest() {
    answers_.bus().subscribe(channels::kPlanUnseen, [this](const PlanUnseen& unseen) { heard_.push_back(unseen); });
    SightingSet frame = frame_at(kNow, 0, Vec2(0, 0), [](double) { return 10.0; });
    for (std::int16_t& depth : frame.view.depths) depth = kBlindDepth;
    watch_.add(frame);
  }
  /// A straight way of 3 s to rest.
  static TimedSpline way(double metres, UTime start = kStart) {
    TimedSpline way{start, {500'000}, Points(3, 9)};
    for (int k = 0; k < 9; ++k) way.control_points.col(k) = kHome + Vec3(std::clamp(k - 2, 0, 4) * metres / 4.0, 0, 0);
    return way;
  }
  static HorizonRequest request(std::int64_t id, const TimedSpline& committed) {
    HorizonRequest r = request_at(kStart, committed);
    r.id = id;
    r.header.name = {7, id};
    return r;
  }
  static Plan plan(const HorizonRequest& request, PlanOutcome outcome, const TimedSpline& trajectory) {
    Plan plan = unanswered(request);
    plan.outcome = outcome;
    plan.trajectory = trajectory;
    return plan;
  }
  std::shared_ptr<const UnseenKnowledge> known() const { return std::make_shared<UnseenKnowledge>(watch_.knowledge()); }
  PlanUnseen answered(const Plan& plan) {
    heard_.clear();
    desk_.answered(plan);
    answers_.hear();
    EXPECT_EQ(heard_.size(), 1u);
    return heard_.empty() ? PlanUnseen{} : heard_.front();
  }

  SharedClock clock_{kNow};
  std::shared_ptr<lcm::LCM> lcm_ = std::make_shared<lcm::LCM>("memq://");
  Bus bus_{lcm_, clock_, 1};
  Answers answers_{lcm_, clock_};
  UnseenWatch watch_{UnseenMovers{}, kHome};
  UnseenDesk desk_{bus_};
  std::vector<PlanUnseen> heard_;
};

TEST_F(UnseenDeskTest, NamesTheRequestAndTheTimesToContactOfBothTrajectories) {
  const HorizonRequest asked = request(5, resting_at(kHome, kNow - Duration{1'000'000}));
  desk_.begin(asked, known());
  const TimedSpline far = way(4.0);
  const PlanUnseen unseen = answered(plan(asked, PlanOutcome::Optimized, far));
  EXPECT_EQ(unseen.request_id, 5);
  EXPECT_EQ(unseen.request, asked.header.name);
  EXPECT_EQ(unseen.start, kStart);
  EXPECT_EQ(unseen.committed_clear, kMaxSpan) << "at rest";
  const double radius = upright_radius(grown(asked.body, asked.tube));
  const double contact_s = first_contact(watch_.knowledge(), far, kStart, radius);
  ASSERT_NE(contact_s, kNoContact);
  EXPECT_EQ(unseen.plan_clear, Duration::from_seconds(contact_s));
}

TEST_F(UnseenDeskTest, AnswersWithoutATrajectoryAreAsClearAsTheCommittedOne) {
  const HorizonRequest asked = request(5, way(4.0));
  desk_.begin(asked, known());
  const PlanUnseen none = answered(plan(asked, PlanOutcome::NoPlan, resting_at(kHome, kNow)));
  EXPECT_LT(none.committed_clear, Duration{3'000'000});
  EXPECT_EQ(none.plan_clear, none.committed_clear);
  const PlanUnseen kept = answered(plan(asked, PlanOutcome::KeepCommitted, asked.committed));
  EXPECT_EQ(kept.plan_clear, kept.committed_clear);
}

TEST_F(UnseenDeskTest, BeforeTheFirstPictureNoMotionIsClear) {
  const HorizonRequest asked = request(5, way(0.2));
  desk_.begin(asked, std::make_shared<UnseenKnowledge>());
  EXPECT_EQ(answered(plan(asked, PlanOutcome::KeepCommitted, asked.committed)).committed_clear, Duration{0});
}

TEST_F(UnseenDeskTest, APlanForAnotherRequestIsPassedOver) {
  const HorizonRequest asked = request(5, way(0.2));
  desk_.answered(unanswered(asked));
  desk_.begin(request(6, way(0.2)), known());
  desk_.answered(unanswered(asked));
  answers_.hear();
  EXPECT_TRUE(heard_.empty());
}

}  // namespace
}  // namespace tern
