#include "monitor/certified_share.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace tern {
namespace {

constexpr UTime kStart{1'000'000'000};

UTime at(double s) { return kStart + Duration::from_seconds(s); }

HorizonRequest request(std::int64_t id, double t_s) {
  HorizonRequest request;
  request.header.name = {7, id};
  request.id = id;
  request.t_s = at(t_s);
  return request;
}

PlanUnseen answer(std::int64_t id, bool certified) {
  PlanUnseen unseen;
  unseen.request = {7, id};
  unseen.committed_clear = certified ? kMaxSpan : Duration{100'000};
  unseen.plan_clear = certified ? Duration{100'000} : kMaxSpan;
  return unseen;
}

TEST(CertifiedShare, IsNoneWithoutPlanUnseenAndWithoutTime) {
  CertifiedShare share;
  EXPECT_FALSE(share.until(at(1)));
  share.add(request(1, 0.0));
  EXPECT_FALSE(share.until(at(1))) << "planner.unseen: ignore";
  share.add(answer(1, true));
  EXPECT_FALSE(share.until(at(0)));
  EXPECT_EQ(share.until(at(1)), 1.0);
}

TEST(CertifiedShare, CountsTheCommittedTrajectoryFromEachStartToTheNextAndNotThePlan) {
  CertifiedShare share;
  share.add(request(1, 0.0));
  share.add(answer(1, true));
  share.add(request(2, 0.3));
  share.add(answer(2, false));
  EXPECT_DOUBLE_EQ(share.until(at(1.0)).value(), 0.3);
}

TEST(CertifiedShare, TimeWithoutAWordOfThePlannerIsNotCertified) {
  CertifiedShare share;
  share.add(request(1, 0.0));
  share.add(answer(1, true));
  share.add(request(2, 0.5));
  share.add(answer(99, true));
  EXPECT_DOUBLE_EQ(share.until(at(1.0)).value(), 0.5);
}

TEST(CertifiedShare, IsTheSumOverTheWholeFlightThoughAnswersComeLate) {
  Rng rng(3);
  CertifiedShare share;
  double t = 0.0, certified_s = 0.0;
  std::optional<PlanUnseen> late;
  for (std::int64_t id = 1; id <= 500; ++id) {
    const bool certified = rng.uniform() < 0.7;
    const double lasts = rng.uniform(0.05, 0.2);
    share.add(request(id, t));
    if (late) share.add(*late);
    late.reset();
    if (rng.uniform() < 0.3) {
      late = answer(id, certified);
    } else {
      share.add(answer(id, certified));
    }
    certified_s += certified ? lasts : 0.0;
    t += lasts;
  }
  if (late) share.add(*late);
  EXPECT_NEAR(share.until(at(t)).value(), certified_s / t, 1e-5);
}

}  // namespace
}  // namespace tern
