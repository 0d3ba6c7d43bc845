// The start gate and the beat.
#include "simulator/app/start_gate.h"

#include <gtest/gtest.h>

#include "simulator/app/beat.h"

namespace tern {
namespace {

constexpr UTime kNow{1'700'000'000'000'000};
constexpr Duration kMs{1'000};

Heartbeat heartbeat(const std::string& process, ProcessState state, const std::string& waiting_for = "") {
  Heartbeat message;
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

TEST(StartGate, OfNobodyIsOpen) { EXPECT_TRUE(StartGate({}).open(kNow)); }

TEST(Beat, KeepsItsPhaseAndSkipsWhatWasMissed) {
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow), kNow + kMs * 10);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 9), kNow + kMs * 10);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 10), kNow + kMs * 20);
  EXPECT_EQ(next_beat(kNow, kMs * 10, kNow + kMs * 57), kNow + kMs * 60);
}

}  // namespace
}  // namespace tern
