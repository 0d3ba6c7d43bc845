// The start gate and the beat.
#include "simulator/app/start_gate.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

#include "simulator/app/beat.h"

namespace tern {
namespace {

constexpr UTime kNow{1'700'000'000'000'000};
constexpr Duration kMs{1'000};

Heartbeat heartbeat(const std::string& process, ProcessState state, const std::string& waiting_for = "") {
  Heartbeat message;
  message.header = {{kNow.us, 1}, kNow};
  message.process = process;
  message.state = state;
  message.waiting_for = waiting_for;
  return message;
}

TEST(StartGate, OpensWhenEveryoneIsReadyAndSaysWhoIsNot) {
  StartGate gate({"tern-planner", "tern-mapper"});
  EXPECT_EQ(gate.missing(kNow), "tern-planner (not heard), tern-mapper (not heard)");
  gate.hear(heartbeat("tern-mapper", ProcessState::Ready), kNow);
  gate.hear(heartbeat("tern-planner", ProcessState::Waiting, "a map"), kNow);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (waits for a map)");
  gate.hear(heartbeat("tern-planner", ProcessState::Starting), kNow);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (not ready)");
  gate.hear(heartbeat("tern-planner", ProcessState::Ready), kNow);
  EXPECT_TRUE(gate.open(kNow));
}

TEST(StartGate, ForgetsWhoIsNoLongerHeard) {
  StartGate gate({"tern-planner"});
  gate.hear(heartbeat("tern-planner", ProcessState::Ready), kNow);
  EXPECT_TRUE(gate.open(kNow + StartGate::kHeartbeatAge));
  EXPECT_EQ(gate.missing(kNow + StartGate::kHeartbeatAge + kMs), "tern-planner (no longer heard)");
}

TEST(StartGate, IsClosedToAClockTooFarFromItsOwnAndSaysWhoseByHowMuchAndWhatToDo) {
  Heartbeat message = heartbeat("tern-planner", ProcessState::Ready);
  for (const auto& [skew_us, text] : std::map<std::int64_t, std::string>{
           {-100'000,
            "tern-planner (its clock is 100.0 ms behind the vehicle's, more than 10 ms: synchronize the hosts' "
            "clocks)"},
           {-10'001,
            "tern-planner (its clock is 10.0 ms behind the vehicle's, more than 10 ms: synchronize the hosts' clocks)"},
           {-10'000, ""},
           {10'000, ""},
           {12'500,
            "tern-planner (its clock is 12.5 ms ahead of the vehicle's, more than 10 ms: synchronize the hosts' "
            "clocks)"}}) {
    StartGate gate({"tern-planner"});
    message.header.utime = kNow + Duration{skew_us};
    gate.hear(message, kNow);
    EXPECT_EQ(gate.missing(kNow), text);
    EXPECT_EQ(gate.skewed(), text);
  }
}

TEST(StartGate, TakesADelayForSkewOnlyUntilAMessageComesFaster) {
  StartGate gate({"tern-planner"});
  const Heartbeat message = heartbeat("tern-planner", ProcessState::Ready);
  gate.hear(message, kNow + kMs * 30);
  EXPECT_FALSE(gate.open(kNow + kMs * 30));
  gate.hear(message, kNow + kMs * 2);
  gate.hear(message, kNow + kMs * 30);
  EXPECT_TRUE(gate.open(kNow + kMs * 30));
  EXPECT_EQ(gate.clocks(), "tern-planner -2.0 ms");
}

TEST(StartGate, NoticesAClockThatIsSetAndForgetsItWithItsProcess) {
  StartGate gate({"tern-planner"});
  Heartbeat message = heartbeat("tern-planner", ProcessState::Ready);
  gate.hear(message, kNow);
  message.header.utime = kNow - kMs * 50;
  for (std::size_t k = 1; k < ClockSkew::kWindow; ++k) gate.hear(message, kNow);
  EXPECT_TRUE(gate.open(kNow));
  gate.hear(message, kNow);
  EXPECT_FALSE(gate.open(kNow));
  message.header = {{kNow.us + 1, 1}, kNow};
  gate.hear(message, kNow);
  EXPECT_TRUE(gate.open(kNow));
}

TEST(StartGate, OfNobodyIsOpen) { EXPECT_TRUE(StartGate({}).open(kNow)); }

TEST(Beat, KeepsItsPhaseAndSkipsWhatWasMissed) {
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow), kNow + kMs * 10);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 9), kNow + kMs * 10);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 10), kNow + kMs * 20);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 57), kNow + kMs * 60);
}

}  // namespace
}  // namespace tern
