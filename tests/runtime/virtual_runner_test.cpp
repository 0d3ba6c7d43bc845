// Many nodes in virtual time: order, determinism, no losses.
#include "runtime/virtual_runner.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "messages/codec.h"
#include "talker.h"

namespace tern {
namespace {

using Journal = std::vector<std::string>;

constexpr UTime kStart{1'000'000};
constexpr Duration kSecond{1'000'000};

Talker& add(VirtualRunner& runner, Talker::Options options, Journal* journal) {
  const auto make = [&](Bus& bus) { return std::make_unique<Talker>(bus, options, journal); };
  return static_cast<Talker&>(runner.start(options.name, make));
}

/// Three talkers of unlike periods, one of which dies and comes back.
Journal flight() {
  Journal journal;
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{3'000}}, &journal);
  add(runner, {"b", Duration{5'000}}, &journal);
  add(runner, {"c", Duration{7'000}}, &journal);
  runner.run(kStart + kSecond);
  runner.stop("b");
  runner.run(kStart + kSecond * 2);
  add(runner, {"b", Duration{5'000}}, &journal);
  runner.run(kStart + kSecond * 3);
  return journal;
}

TEST(VirtualRunner, EqualFlightsGiveEqualJournals) {
  const Journal first = flight();
  EXPECT_GT(first.size(), 1'000U);
  EXPECT_EQ(first, flight());
}

TEST(VirtualRunner, StepsInOrderOfStartAndDeliversInOrderOfPublishing) {
  Journal journal;
  VirtualRunner runner(kStart);
  add(runner, {"a", kSecond}, &journal);
  add(runner, {"b", kSecond}, &journal);
  runner.run(kStart);
  EXPECT_EQ(journal,
            (Journal{"1000000 a says 1", "1000000 b says 1", "1000000 a hears 1 of 1000000",
                     "1000000 b hears 1 of 1000000", "1000000 a hears 1 of 1000001", "1000000 b hears 1 of 1000001"}));
}

TEST(VirtualRunner, TimeJumpsToTheEarliestWakeup) {
  Journal journal;
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{123'457}}, &journal);
  runner.run(kStart + Duration{200'000});
  EXPECT_EQ(journal.back(), "1123457 a hears 2 of 1000000");
  EXPECT_EQ(runner.now(), kStart + Duration{200'000});
}

TEST(VirtualRunner, ListenersAreSteppedAfterTheirMessages) {
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{10'000}}, nullptr);
  const Talker& listener = add(runner, {"b"}, nullptr);
  runner.run(kStart + Duration{95'000});
  EXPECT_EQ(listener.heard(), 10);
  EXPECT_EQ(listener.steps(), 10);
}

TEST(VirtualRunner, LosesNothingInALongBusySecond) {
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{20}}, nullptr);
  const Talker& listener = add(runner, {"b"}, nullptr);
  std::int64_t lost = 0;
  runner.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& h) {
    for (const auto& [name, counters] : h.channels) lost += counters.lost;
  });
  runner.run(kStart + kSecond);
  EXPECT_EQ(listener.heard(), 50'001);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(runner.observer().counters()[channels::kHeartbeat.name].lost, 0);
}

TEST(VirtualRunner, ReturnsWhenTheConditionHolds) {
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{10'000}}, nullptr);
  const Talker& listener = add(runner, {"b"}, nullptr);
  const RunResult result = runner.run(kStart + kSecond, [&] { return listener.heard() >= 3; });
  EXPECT_EQ(result.end, RunEnd::Condition);
  EXPECT_EQ(runner.now(), kStart + Duration{20'000});
}

TEST(VirtualRunner, ReturnsWhenANodeHasFinishedWithItsCode) {
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{10'000}, 3}, nullptr);
  std::vector<ProcessState> states;
  runner.observer().subscribe(channels::kHeartbeat, [&](const Heartbeat& h) { states.push_back(h.state); });
  const RunResult result = runner.run(kStart + kSecond);
  EXPECT_EQ(result.end, RunEnd::Finished);
  EXPECT_EQ(result.process, "a");
  EXPECT_EQ(result.exit_code, 7);
  EXPECT_EQ(runner.now(), kStart + Duration{20'000});
  EXPECT_EQ(states, (std::vector<ProcessState>{ProcessState::Ready, ProcessState::Finished}));
}

TEST(VirtualRunner, AStoppedProcessIsSilentAndARestartedOneHasANewerEpoch) {
  VirtualRunner runner(kStart);
  add(runner, {"a", Duration{10'000}}, nullptr);
  std::vector<std::int64_t> epochs;
  runner.observer().subscribe(channels::kGoal, [&](const Goal& g) { epochs.push_back(g.header.name.sender_epoch_us); });
  runner.run(kStart);
  runner.stop("a");
  runner.run(kStart + kSecond);
  EXPECT_EQ(epochs.size(), 1U);
  add(runner, {"a", Duration{10'000}}, nullptr);
  runner.run(kStart + kSecond);
  ASSERT_EQ(epochs.size(), 2U);
  EXPECT_GT(epochs[1], epochs[0]);
  EXPECT_EQ(runner.observer().counters()[channels::kGoal.name].lost, 0);
  EXPECT_THROW(runner.stop("nobody"), std::invalid_argument);
}

/// Answers every goal with the next one, at once: time can never pass.
class Echo final : public Node {
 public:
  explicit Echo(Bus& bus) {
    bus.subscribe(channels::kGoal, [&bus](const Goal& goal) {
      Goal next = goal;
      ++next.id;
      bus.publish(channels::kGoal, next);
    });
  }
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
};

TEST(VirtualRunner, RefusesNodesThatKeepEachOtherBusyWithoutTimePassing) {
  class Impatient final : public Node {
    [[nodiscard]] UTime next_wakeup() const override { return UTime{}; }
    void step(UTime /*now*/) override {}
    [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  };
  VirtualRunner runner(kStart);
  runner.start("impatient", [](Bus&) { return std::make_unique<Impatient>(); });
  EXPECT_THROW(runner.run(kStart), std::logic_error);
}

TEST(VirtualRunner, DeliversAnAnswerToAnAnswerInTheSameInstant) {
  VirtualRunner runner(kStart);
  runner.start("echo", [](Bus& bus) { return std::make_unique<Echo>(bus); });
  int count = 0;
  runner.observer().subscribe(channels::kGoal, [&](const Goal&) {
    if (++count == 100) throw std::runtime_error("a hundred");
  });
  Goal goal;
  goal.id = 1;
  runner.observer().publish(channels::kGoal, goal);
  EXPECT_THROW(runner.run(kStart), std::runtime_error);
  EXPECT_EQ(runner.now(), kStart);
}

TEST(VirtualRunner, WhatANodeThrowsComesOutOfRun) {
  class Broken final : public Node {
   public:
    [[nodiscard]] UTime next_wakeup() const override { return kStart; }
    void step(UTime /*now*/) override { throw std::domain_error("broken"); }
    [[nodiscard]] NodeHealth health() const override { return {}; }
  };
  VirtualRunner runner(kStart);
  runner.start("broken", [](Bus&) { return std::make_unique<Broken>(); });
  EXPECT_THROW(runner.run(kStart), std::domain_error);
}

}  // namespace
}  // namespace tern
