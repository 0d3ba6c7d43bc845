// The start gate and the beat.
#include "simulator/app/start_gate.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>

#include "runtime/tick.h"

namespace tern {
namespace {

constexpr UTime kNow{1'700'000'000'000'000};
constexpr Duration kMs{1'000};

constexpr std::int64_t kOwnEpoch = 77;

/// A heartbeat that echoes one of the listener's; sent, answered and received at kNow.
Heartbeat heartbeat(const std::string& process, ProcessState state, const std::string& waiting_for = "") {
  Heartbeat message;
  message.header = {{kNow.us, 1}, kNow};
  message.process = process;
  message.state = state;
  message.waiting_for = waiting_for;
  message.echoes = {{kOwnEpoch - 1, UTime{1}, UTime{2}}, {kOwnEpoch, kNow, kNow}};
  return message;
}

/// The planner's heartbeat of an exchange that began at kNow, with its receive time; its clock is `ahead`.
struct Exchange {
  Duration ahead, out, back;
  [[nodiscard]] UTime received() const { return kNow + out + held + back; }
  [[nodiscard]] Heartbeat message() const {
    Heartbeat message = heartbeat("tern-planner", ProcessState::Ready);
    message.echoes = {{kOwnEpoch, kNow, kNow + out + ahead}};
    message.header.utime = kNow + out + held + ahead;
    return message;
  }
  Duration held{123'000};
};

TEST(StartGate, OpensWhenEveryoneIsReadyAndSaysWhoIsNot) {
  StartGate gate({"tern-planner", "tern-mapper"}, kOwnEpoch);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (no HEARTBEAT), tern-mapper (no HEARTBEAT)");
  gate.receive(heartbeat("tern-mapper", ProcessState::Ready), kNow);
  gate.receive(heartbeat("tern-planner", ProcessState::Waiting, "a map"), kNow);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (waits: a map)");
  gate.receive(heartbeat("tern-planner", ProcessState::Starting), kNow);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (not ready)");
  gate.receive(heartbeat("tern-planner", ProcessState::Failed, "the disk is full"), kNow);
  EXPECT_EQ(gate.missing(kNow), "tern-planner (the disk is full)");
  gate.receive(heartbeat("tern-planner", ProcessState::Ready), kNow);
  EXPECT_TRUE(gate.open(kNow));
}

TEST(StartGate, KnowsWhetherTheLogHoldsWhatIsPublished) {
  EXPECT_TRUE(StartGate({"tern-planner"}, kOwnEpoch).records(kNow)) << "nobody records";
  StartGate gate({"tern-planner", kRecorder}, kOwnEpoch);
  EXPECT_FALSE(gate.records(kNow));
  gate.receive(heartbeat(kRecorder, ProcessState::Waiting, "CONFIGURATION of tern-planner"), kNow);
  EXPECT_FALSE(gate.records(kNow));
  EXPECT_EQ(gate.missing(kNow), "tern-planner (no HEARTBEAT), tern-logger (waits: CONFIGURATION of tern-planner)");
  gate.receive(heartbeat(kRecorder, ProcessState::Ready), kNow);
  EXPECT_TRUE(gate.records(kNow));
  EXPECT_FALSE(gate.records(kNow + StartGate::kHeartbeatAge + kMs));
}

TEST(StartGate, ForgetsWhoIsNoLongerHeard) {
  StartGate gate({"tern-planner"}, kOwnEpoch);
  gate.receive(heartbeat("tern-planner", ProcessState::Ready), kNow);
  EXPECT_TRUE(gate.open(kNow + StartGate::kHeartbeatAge));
  EXPECT_EQ(gate.missing(kNow + StartGate::kHeartbeatAge + kMs), "tern-planner (its HEARTBEAT has ceased)");
}

TEST(StartGate, IsClosedToAClockTooFarFromItsOwnAndSaysWhoseByHowMuchAndWhatToDo) {
  const std::string rest =
      " the vehicle's, more than 10 ms and half a round trip of 0.4 ms: synchronize the hosts' clocks)";
  for (const auto& [skew_us, text] :
       std::map<std::int64_t, std::string>{{-100'000, "tern-planner (its clock is 100.0 ms behind" + rest},
                                           {-10'201, "tern-planner (its clock is 10.2 ms behind" + rest},
                                           {-10'200, ""},
                                           {10'200, ""},
                                           {12'500, "tern-planner (its clock is 12.5 ms ahead of" + rest}}) {
    StartGate gate({"tern-planner"}, kOwnEpoch);
    const Exchange exchange{Duration{skew_us}, Duration{200}, Duration{200}};
    gate.receive(exchange.message(), exchange.received());
    EXPECT_EQ(gate.missing(exchange.received()), text);
    EXPECT_EQ(gate.skewed(), text);
  }
}

TEST(StartGate, NeverTakesADelayForSkewHoweverItIsSharedBetweenTheWays) {
  for (const std::int64_t out_ms : {0, 1, 10, 60, 500}) {
    for (const std::int64_t back_ms : {0, 1, 10, 60, 500}) {
      for (const std::int64_t skew_us : {-10'000, 0, 10'000}) {
        StartGate gate({"tern-planner"}, kOwnEpoch);
        const Exchange exchange{Duration{skew_us}, kMs * out_ms, kMs * back_ms};
        gate.receive(exchange.message(), exchange.received());
        EXPECT_TRUE(gate.open(exchange.received())) << gate.missing(exchange.received());
      }
    }
  }
}

TEST(StartGate, TellsOffsetAndDelayApart) {
  StartGate gate({"tern-planner"}, kOwnEpoch);
  const Exchange exchange{kMs * 5, kMs * 10, kMs * 10};
  gate.receive(exchange.message(), exchange.received());
  EXPECT_EQ(gate.clocks(), "tern-planner +5.0 ms (round trip 20.0 ms)");
}

TEST(StartGate, BelievesTheExchangeOfTheShortestRoundTrip) {
  StartGate gate({"tern-planner"}, kOwnEpoch);
  for (const Exchange& exchange :
       {Exchange{kMs * 20, kMs * 40, kMs}, Exchange{kMs * 20, kMs, kMs}, Exchange{kMs * 20, kMs, kMs * 40}}) {
    gate.receive(exchange.message(), exchange.received());
  }
  EXPECT_EQ(gate.clocks(), "tern-planner +20.0 ms (round trip 2.0 ms)");
  EXPECT_FALSE(gate.open(kNow));
}

TEST(StartGate, IsClosedToAClockThatCannotBeCompared) {
  const std::string text = "tern-planner (has not echoed a HEARTBEAT: its clock cannot be compared)";
  StartGate gate({"tern-planner"}, kOwnEpoch);
  Heartbeat message = heartbeat("tern-planner", ProcessState::Ready);
  message.echoes.pop_back();  // an echo of another process
  gate.receive(message, kNow);
  EXPECT_EQ(gate.missing(kNow), text);
  const Exchange impossible{{}, kMs * -1, {}};
  gate.receive(impossible.message(), impossible.received());
  EXPECT_EQ(gate.missing(kNow), text);
  EXPECT_EQ(gate.clocks(), "");
  EXPECT_EQ(gate.skewed(), "");
}

TEST(StartGate, NoticesAClockThatIsSetAndForgetsItWithItsProcess) {
  StartGate gate({"tern-planner"}, kOwnEpoch);
  const Exchange before{{}, Duration{200}, Duration{200}};
  const Exchange after{kMs * -50, Duration{300}, Duration{300}};
  gate.receive(before.message(), kNow + before.held);
  for (std::size_t k = 1; k < ClockSkew::kWindow; ++k) gate.receive(after.message(), after.received());
  EXPECT_TRUE(gate.open(kNow));
  gate.receive(after.message(), after.received());
  EXPECT_FALSE(gate.open(kNow));
  Heartbeat anew = before.message();
  ++anew.header.name.sender_epoch_us;
  gate.receive(anew, before.received());
  EXPECT_TRUE(gate.open(kNow));
}

TEST(StartGate, OfNobodyIsOpen) { EXPECT_TRUE(StartGate({}, kOwnEpoch).open(kNow)); }

TEST(Beat, KeepsItsPhaseAndSkipsWhatWasMissed) {
  EXPECT_EQ(next_tick(kNow, kMs * 10, kNow), kNow + kMs * 10);
  EXPECT_EQ(next_tick(kNow, kMs * 10, kNow + kMs * 9), kNow + kMs * 10);
  EXPECT_EQ(next_tick(kNow, kMs * 10, kNow + kMs * 10), kNow + kMs * 20);
  EXPECT_EQ(next_tick(kNow, kMs * 10, kNow + kMs * 57), kNow + kMs * 60);
}

}  // namespace
}  // namespace tern
