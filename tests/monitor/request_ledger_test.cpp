#include "monitor/request_ledger.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

constexpr UTime kDeadline{1'000'000};

HorizonRequest request(std::int64_t id) {
  HorizonRequest request;
  request.id = id;
  request.deadline = kDeadline;
  return request;
}

Plan plan(std::int64_t id, UTime at, PlanOutcome outcome = PlanOutcome::Optimized) {
  Plan plan;
  plan.request_id = id;
  plan.header.utime = at;
  plan.outcome = outcome;
  return plan;
}

TEST(RequestLedger, AnAnswerAtTheDeadlineIsInTime) {
  RequestLedger ledger;
  ledger.add(request(1));
  ledger.add(plan(1, kDeadline));
  EXPECT_EQ(ledger.requests(), 1);
  EXPECT_EQ(ledger.answered_in_time(), 1);
}

TEST(RequestLedger, AnAnswerAfterTheDeadlineIsNot) {
  RequestLedger ledger;
  ledger.add(request(1));
  ledger.add(plan(1, kDeadline + Duration{1}));
  EXPECT_EQ(ledger.requests(), 1);
  EXPECT_EQ(ledger.answered_in_time(), 0);
}

TEST(RequestLedger, ASecondAnswerIsCountedAsSuchAndNowhereElse) {
  RequestLedger ledger;
  ledger.add(request(1));
  ledger.add(plan(1, kDeadline));
  ledger.add(plan(1, kDeadline, PlanOutcome::Evade));
  EXPECT_EQ(ledger.requests(), 1);
  EXPECT_EQ(ledger.answered_in_time(), 1);
  EXPECT_EQ(ledger.plans(PlanOutcome::Optimized), 1);
  EXPECT_EQ(ledger.plans(PlanOutcome::Evade), 0);
  EXPECT_EQ(ledger.second_answers(), 1);
}

TEST(RequestLedger, OnANetworkThatDeliversEveryMessageTwiceCountsEachOnce) {
  RequestLedger ledger;
  for (std::int64_t id = 1; id <= 10; ++id) {
    HorizonRequest asked = request(id);
    asked.header.name = {7, id};
    Plan answer = plan(id, kDeadline);
    answer.header.name = {9, id};
    for (int copy = 0; copy < 2; ++copy) ledger.add(asked);
    for (int copy = 0; copy < 2; ++copy) ledger.add(answer);
    ledger.add(asked);  // overtaken by its answer
  }
  ledger.advance(kDeadline + kAnswerGrace + Duration{1});
  EXPECT_EQ(ledger.requests(), 10);
  EXPECT_EQ(ledger.answered_in_time(), 10);
  EXPECT_EQ(ledger.plans(PlanOutcome::Optimized), 10);
  EXPECT_EQ(ledger.second_answers(), 0);
}

TEST(RequestLedger, OfTwoPlannersCountsAPlanPerRequest) {
  RequestLedger ledger;
  for (std::int64_t id = 1; id <= 10; ++id) {
    HorizonRequest asked = request(id);
    asked.header.name = {7, id};
    ledger.add(asked);
    for (const std::int64_t planner : {8, 9}) {
      Plan answer = plan(id, kDeadline);
      answer.header.name = {planner, id};
      ledger.add(answer);
    }
  }
  EXPECT_EQ(ledger.requests(), 10);
  EXPECT_EQ(ledger.plans(PlanOutcome::Optimized), 10);
  EXPECT_EQ(ledger.second_answers(), 10);
}

TEST(RequestLedger, AnOpenRequestIsNotCountedBeforeItsDeadlineHasLongPassed) {
  RequestLedger ledger;
  ledger.add(request(1));
  ledger.advance(kDeadline + kAnswerGrace);
  EXPECT_EQ(ledger.requests(), 0);
  ledger.advance(kDeadline + kAnswerGrace + Duration{1});
  EXPECT_EQ(ledger.requests(), 1);
  EXPECT_EQ(ledger.answered_in_time(), 0);
}

TEST(RequestLedger, CountsReasonsAndKeepsTheNewest) {
  RequestLedger ledger;
  EXPECT_EQ(ledger.last_reason(), PlanReason::None);
  Plan stale = plan(1, kDeadline, PlanOutcome::KeepCommitted);
  stale.reason = PlanReason::StaleWorld;
  ledger.add(stale);
  EXPECT_EQ(ledger.last_reason(), PlanReason::StaleWorld);
  ledger.add(plan(2, kDeadline));
  EXPECT_EQ(ledger.last_reason(), PlanReason::None);
  EXPECT_EQ(ledger.plans(PlanReason::StaleWorld), 1);
}

TEST(RequestLedger, CountsThePlansOfIncompleteSetsAndKeepsTheNewest) {
  RequestLedger ledger;
  std::int64_t id = 0;
  for (const std::int32_t left_out : {0, 12, 3, 0}) {
    Plan incomplete = plan(++id, kDeadline);
    incomplete.inputs.left_out = left_out;
    ledger.add(incomplete);
    EXPECT_EQ(ledger.last_left_out(), left_out);
  }
  EXPECT_EQ(ledger.left_out().plans, 2);
  EXPECT_EQ(ledger.left_out().max_tracks, 12);
}

TEST(RequestLedger, CountsTrajectoriesByTheirConfidence) {
  RequestLedger ledger;
  const auto sure = [](std::int64_t id, double confidence, int level) {
    Plan one = plan(id, kDeadline);
    one.confidence = confidence;
    one.level = level;
    return one;
  };
  ledger.add(sure(1, 0.99, 0));
  ledger.add(plan(2, kDeadline, PlanOutcome::NoPlan));
  ledger.add(sure(3, 0.6, kLevels - 1));
  Plan less = sure(4, 0.0, kLevels - 1);
  less.alpha_scale = 0.5;
  ledger.add(less);
  less = sure(5, 0.99, 0);
  less.sure_for = Duration{300'000};
  ledger.add(less);
  EXPECT_EQ(ledger.plans_by_level(), (PlansByLevel{2, 0, 0, 0, 1, 1}));
  EXPECT_EQ(ledger.plans_for_a_time(), 1);
}

TEST(RequestLedger, AnAnswerToNobodySettlesNothing) {
  RequestLedger ledger;
  ledger.add(plan(7, kDeadline, PlanOutcome::NoPlan));
  EXPECT_EQ(ledger.requests(), 0);
  EXPECT_EQ(ledger.plans(PlanOutcome::NoPlan), 1);
}

}  // namespace
}  // namespace tern
