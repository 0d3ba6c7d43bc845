// The bus: names, counters, firewall, pacing.
#include "runtime/bus.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "core/wire/message_limits.h"
#include "messages/codec.h"
#include "runtime/lcm_network.h"
#include "runtime/node.h"
#include "runtime/sender_watch.h"

namespace tern {
namespace {

constexpr const auto& kChannel = channels::kGoal;

Goal goal(std::int64_t id) {
  Goal g;
  g.id = id;
  return g;
}

template <class T, class Handler>
concept MaySubscribe = requires(Bus& end, const Channel<T>& channel, Handler handler) {
  end.subscribe(channel, handler);
};
template <class T, class Message>
concept MayPublish = requires(Bus& end, const Channel<T>& channel, Message message) {
  end.publish(channel, message);
};

// A message of another type than the channel's does not compile.
static_assert(MaySubscribe<Plan, void (*)(const Plan&)> && !MaySubscribe<Plan, void (*)(const Goal&)>);
static_assert(MayPublish<Plan, Plan> && !MayPublish<Plan, Goal>);

/// A network within the test: `bus` listens; arrive() plays remote senders, which give names of their own making.
class BusTest : public testing::Test {
 protected:
  void listen() {
    bus.subscribe(kChannel, [this](const Goal& g) { heard.push_back(g); });
  }

  void arrive(std::int64_t epoch_us, std::int64_t sequence) {
    Goal g = goal(1);
    g.header = {{epoch_us, sequence}, clock.now()};
    arrive_bytes(encode(g));
  }

  void arrive_bytes(const Bytes& bytes) {
    lcm->publish(kChannel.name, bytes.data(), static_cast<unsigned>(bytes.size()));
  }

  ChannelCounters settle() {
    drain(*lcm, 1'000'000);
    bus.rethrow();
    return bus.counters()[kChannel.name];
  }

  std::shared_ptr<lcm::LCM> lcm = std::make_shared<lcm::LCM>("memq://");
  VirtualClock clock{UTime{5'000'000}};
  Bus bus{lcm, clock, 1'000};
  std::vector<Goal> heard;
};

TEST_F(BusTest, NamesMessagesBySenderEpochAndAscendingSequence) {
  listen();
  const MessageName first = bus.publish(kChannel, goal(7));
  const MessageName second = bus.publish(kChannel, goal(8));
  EXPECT_EQ(first, (MessageName{1'000, 1}));
  EXPECT_EQ(second, (MessageName{1'000, 2}));
  settle();
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_EQ(heard[1].header.name, second);
  EXPECT_EQ(heard[1].header.utime, clock.now());
  EXPECT_EQ(heard[1].id, 8);
}

TEST_F(BusTest, CountsSequencesPerChannel) {
  bus.publish(kChannel, goal(1));
  EXPECT_EQ(bus.publish(Channel<Goal>{"GOAL_2"}, goal(1)).sequence, 1);
}

TEST_F(BusTest, ItsOwnMessagesAreDeliveredAndAreNoLoss) {
  listen();
  for (int i = 1; i <= 10; ++i) bus.publish(kChannel, goal(i));
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.sent, 10);
  EXPECT_EQ(counters.received, 10);
  EXPECT_EQ(counters.lost, 0);
}

TEST_F(BusTest, GapsInASendersSequenceAreCountedAsLost) {
  listen();
  for (const int sequence : {10, 11, 14, 15, 16}) arrive(50, sequence);
  EXPECT_EQ(settle().lost, 2);
}

TEST_F(BusTest, ALateJoinerHasLostNothing) {
  listen();
  arrive(50, 1'000'000);
  EXPECT_EQ(settle().lost, 0);
}

TEST_F(BusTest, ARestartedSenderIsNoLoss) {
  listen();
  arrive(50, 10);
  arrive(60, 1);
  arrive(60, 2);
  EXPECT_EQ(settle().lost, 0);
}

TEST_F(BusTest, SendersAreCountedApart) {
  listen();
  for (int i = 1; i <= 5; ++i) {
    arrive(50, i);
    arrive(60, 2 * i);
  }
  arrive(60, 11);
  EXPECT_EQ(settle().lost, 4);
}

TEST_F(BusTest, AnOvertakenMessageIsNoLossAndARepeatedOneIsHandedOverOnce) {
  listen();
  for (const int sequence : {1, 2, 5, 3, 5, 6}) arrive(50, sequence);
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.lost, 1) << "the fourth";
  EXPECT_EQ(counters.received, 5);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Repeated)], 1);
  EXPECT_EQ(heard.size(), 5U);
}

TEST_F(BusTest, AFarSequenceIsRefusedAndMovesNoCount) {
  listen();
  for (int i = 1; i <= 40; ++i) {
    arrive(50, i);
    arrive(50, std::numeric_limits<std::int64_t>::max() - i);
  }
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.lost, 0);
  EXPECT_EQ(counters.received, 40);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Sender)], 40);
}

TEST_F(BusTest, WhatIsFromTheFutureReachesNoHandler) {
  listen();
  const UTime now = clock.now();
  const auto forge = [&](std::int64_t epoch_us, UTime sent, std::int64_t id) {
    Goal g = goal(id);
    g.header = {{epoch_us, 1}, sent};
    arrive_bytes(encode(g));
  };
  forge(60, now + kMaxAhead, now.us);
  EXPECT_EQ(settle().received, 1) << "clocks differ a little";
  forge(61, now, kMaxGoalId);
  forge(62, now, (now + kMaxAhead).us + 1);
  forge((now + kMaxAhead).us + 1, now, 1);
  forge(63, now + kMaxAhead + Duration{1}, 1);
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 1);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Future)], 4);
  EXPECT_EQ(heard.size(), 1U);
  EXPECT_EQ(bus.sender_troubles(), "GOAL: stamped 0.1 s ahead of this clock, refused: synchronize the clocks");
}

TEST_F(BusTest, SaysWhichFieldIsRefusedAndHowOften) {
  bus.subscribe(channels::kGoal, [](const Goal&) {});
  Goal bad = goal(1);
  bad.position.y() = std::numeric_limits<double>::quiet_NaN();
  const auto send = [&](int times) {
    for (int k = 0; k < times; ++k) {
      bad.header = {{50, k + 1}, clock.now()};
      arrive_bytes(encode(bad));
      settle();
      clock.advance_to(clock.now() + Duration{50'000});
    }
  };
  send(2);
  EXPECT_EQ(bus.sender_troubles(), "") << "twice may be noise";
  send(3);
  EXPECT_EQ(bus.sender_troubles(), "GOAL: 5 refused: position.y is nan");
  send(40);
  EXPECT_EQ(bus.sender_troubles(), "GOAL: 20/s refused: position.y is nan");
  clock.advance_to(clock.now() + kSenderTroubleReported);
  EXPECT_EQ(bus.sender_troubles(), "");
}

TEST_F(BusTest, AMessageWithoutABadElementIsHandedOverAndTheElementIsCountedAndNamed) {
  std::size_t heard_detections = 0;
  for (int k = 0; k < 2; ++k) {
    bus.subscribe(channels::kObstacleObservations,
                  [&](const ObservationSet& m) { heard_detections += m.detections.size(); });
  }
  ObservationSet set;
  set.detections.resize(4);
  set.detections[1].position.x() = set.detections[3].position.x() = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 3; ++k) {
    set.header = {{50, k + 1}, clock.now()};
    const Bytes bytes = encode(set);
    lcm->publish(channels::kObstacleObservations.name, bytes.data(), static_cast<unsigned>(bytes.size()));
    settle();
  }
  const ChannelCounters counters = bus.counters()[channels::kObstacleObservations.name];
  EXPECT_EQ(heard_detections, 2U * 3U * 2U);
  EXPECT_EQ(counters.received, 3);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Number)], 6);
  EXPECT_EQ(bus.sender_troubles(),
            "OBSTACLE_OBSERVATIONS: 6 refused: detections[1].position.x is nan (the others are used)");
}

TEST_F(BusTest, SaysWhichNumberIsRepeated) {
  listen();
  for (int k = 0; k < 4; ++k) arrive(50, 1);
  settle();
  EXPECT_EQ(bus.sender_troubles(), "GOAL: 3 refused: repeats number 1");
}

TEST_F(BusTest, ItsOwnNameIsHeardOnlyWhereItHasSpoken) {
  listen();
  bus.publish(kChannel, goal(1));
  arrive(1'000, 1);
  arrive(1'000, 2);
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 1);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Repeated)], 1);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Sender)], 1);
}

TEST_F(BusTest, ForgedSendersPushOutOnlyTheOnesNotHeardLongest) {
  listen();
  arrive(1, 1);
  for (int i = 2; i <= 2'000; ++i) {
    arrive(i, 1);
    arrive(1, i);
  }
  arrive(1, 2'002);
  arrive(1, 2'003);
  EXPECT_EQ(settle().lost, 1) << "the sender that was heard all along is still known";
}

TEST_F(BusTest, RefusedMessagesAreCountedByReasonAndReachNoHandler) {
  listen();
  Goal g = goal(1);
  g.header = {{50, 1}, clock.now()};
  const Bytes good = encode(g);
  const Bytes truncated(good.begin(), good.end() - 1);
  Bytes trailing = good;
  trailing.push_back(0);
  Bytes another_type = good;
  another_type[0] ^= 0xffU;
  for (const Bytes& bytes : {truncated, trailing, another_type, Bytes{}, good}) arrive_bytes(bytes);
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 1);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Length)], 3);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Fingerprint)], 1);
  EXPECT_EQ(heard.size(), 1U);
}

TEST_F(BusTest, LateMessagesAreCountedBesideReceivedOnes) {
  listen();
  arrive(50, 1);
  bus.count_late(kChannel);
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 1);
  EXPECT_EQ(counters.late, 1);
}

TEST_F(BusTest, SeveralHandlersOfAChannelAreCalledInOrderAndTheMessageIsCountedOnce) {
  std::string order;
  bus.subscribe(kChannel, [&](const Goal&) { order += "a"; });
  bus.subscribe(kChannel, [&](const Goal&) { order += "b"; });
  arrive(50, 1);
  arrive(50, 2);
  arrive(50, 2);
  const ChannelCounters counters = settle();
  EXPECT_EQ(order, "abab");
  EXPECT_EQ(counters.received, 2);
  EXPECT_EQ(counters.rejected[static_cast<int>(Rejection::Repeated)], 1);
}

TEST_F(BusTest, WhatAHandlerThrowsComesOutOfRethrowAndStopsDeliveriesUntilThen) {
  bus.subscribe(kChannel, [&](const Goal& g) {
    heard.push_back(g);
    if (g.header.name.sequence == 1) throw std::runtime_error("handler");
  });
  arrive(50, 1);
  arrive(50, 2);
  drain(*lcm, 100);
  EXPECT_THROW(bus.rethrow(), std::runtime_error);
  EXPECT_EQ(heard.size(), 1U);
  EXPECT_NO_THROW(bus.rethrow());
  arrive(50, 3);
  settle();
  EXPECT_EQ(heard.size(), 2U);
}

TEST_F(BusTest, AMessageThatBreaksItsContractUsesNoNumber) {
  Heartbeat endless;
  endless.process = std::string(1'000'000, 'x');
  EXPECT_THROW(bus.publish(channels::kHeartbeat, endless), std::invalid_argument);
  Heartbeat good;
  good.process = "x";
  EXPECT_EQ(bus.publish(channels::kHeartbeat, good).sequence, 1);
}

TEST_F(BusTest, TheSuffixKeepsVehiclesApartAndCountersPlain) {
  Bus second(lcm, clock, 2'000, "_2");
  int count = 0;
  second.subscribe(kChannel, [&](const Goal&) { ++count; });
  bus.publish(kChannel, goal(1));
  settle();
  EXPECT_EQ(count, 0);
  second.publish(kChannel, goal(1));
  settle();
  EXPECT_EQ(count, 1);
  EXPECT_EQ(second.counters().count(kChannel.name), 1U);
}

TEST_F(BusTest, RefusesNamesThatAreRegularExpressionsOrTooLong) {
  EXPECT_THROW(Bus(lcm, clock, 1, ".*"), std::invalid_argument);
  const std::string too_long(64, 'x');
  EXPECT_THROW(bus.publish(Channel<Goal>{too_long.c_str()}, goal(1)), std::invalid_argument);
}

TEST_F(BusTest, ADestroyedBusHearsNothing) {
  int count = 0;
  {
    Bus gone(lcm, clock, 2'000);
    gone.subscribe(kChannel, [&](const Goal&) { ++count; });
    bus.publish(kChannel, goal(1));
  }
  settle();
  EXPECT_EQ(count, 0);
}

TEST_F(BusTest, APacedSetLeavesOneMessagePerPacingInterval) {
  listen();
  bus.publish_paced(kChannel, std::vector<Goal>{goal(1), goal(2), goal(3)});
  settle();
  EXPECT_EQ(heard.size(), 1U);
  const UTime start = clock.now();
  EXPECT_EQ(bus.next_due(), start + kPacing);
  bus.send_due(start + kPacing - Duration{1});
  settle();
  EXPECT_EQ(heard.size(), 1U) << "not before it is due";
  clock.advance_to(start + kPacing * 10);
  bus.send_due(clock.now());
  settle();
  EXPECT_EQ(heard.size(), 2U) << "one message, however late";
  EXPECT_EQ(bus.next_due(), clock.now() + kPacing);
  clock.advance_to(bus.next_due());
  bus.send_due(clock.now());
  settle();
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[2].id, 3);
  EXPECT_EQ(heard[2].header.utime, clock.now()) << "named when it leaves";
  EXPECT_EQ(bus.next_due(), kNever);
}

TEST_F(BusTest, ANewerPacedSetReplacesTheUnsentRestWithoutAGap) {
  listen();
  bus.publish_paced(kChannel, std::vector<Goal>{goal(1), goal(2), goal(3)});
  bus.publish_paced(kChannel, std::vector<Goal>{goal(4), goal(5)});
  EXPECT_EQ(bus.unsent(), 2);
  clock.advance_to(clock.now() + kPacing);
  bus.send_due(clock.now());
  const ChannelCounters counters = settle();
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[1].id, 4);
  EXPECT_EQ(heard[2].id, 5);
  EXPECT_EQ(counters.lost, 0) << "what was never sent is not lost";
}

TEST_F(BusTest, AnEmptyPacedSetSendsNothing) {
  bus.publish_paced(kChannel, std::vector<Goal>{});
  EXPECT_EQ(bus.next_due(), kNever);
  EXPECT_EQ(bus.counters()[kChannel.name].sent, 0);
}

TEST_F(BusTest, PublishesFromSeveralThreadsInSequence) {
  listen();
  constexpr int kEach = 500;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([this] {
      for (int i = 1; i <= kEach; ++i) bus.publish(kChannel, goal(i));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 4 * kEach);
  EXPECT_EQ(counters.lost, 0);
  for (std::size_t i = 0; i < heard.size(); ++i)
    EXPECT_EQ(heard[i].header.name.sequence, static_cast<std::int64_t>(i) + 1);
}

TEST_F(BusTest, AHandlerMayPublishOnItsOwnChannel) {
  bus.subscribe(kChannel, [&](const Goal& g) {
    heard.push_back(g);
    if (g.id < 100) bus.publish(kChannel, goal(g.id + 1));
  });
  bus.publish(kChannel, goal(1));
  EXPECT_EQ(settle().lost, 0);
  EXPECT_EQ(heard.size(), 100U);
}

TEST_F(BusTest, ReceivedIsWhenAMessageCameInByTheBussClockHoweverLateItIsHandled) {
  const WallClock system, skewed(Duration{-2'000'000});
  Bus late(lcm, skewed, 2'000);
  std::vector<UTime> received;
  late.subscribe(kChannel, [&](const Goal&) { received.push_back(late.received()); });
  std::vector<std::pair<UTime, UTime>> sent;  // no sooner than, no later than
  for (int i = 1; i <= 2; ++i) {
    const UTime before = system.now();
    bus.publish(kChannel, goal(i));
    sent.emplace_back(before, system.now());
    while (system.now() < sent.back().second + Duration{1'000}) {  // so that it is handled later
    }
  }
  drain(*lcm, 1'000'000);
  late.rethrow();
  ASSERT_EQ(received.size(), 2U);
  for (std::size_t i = 0; i < received.size(); ++i) {
    EXPECT_GE(received[i], sent[i].first - Duration{2'000'000});
    EXPECT_LE(received[i], sent[i].second - Duration{2'000'000});
  }
}

TEST_F(BusTest, ReceivedIsNowOnAClockThatHasNothingToDoWithTheSystems) {
  std::vector<UTime> received;
  bus.subscribe(kChannel, [&](const Goal&) { received.push_back(bus.received()); });
  bus.publish(kChannel, goal(1));
  clock.advance_to(UTime{6'000'000});
  settle();
  EXPECT_EQ(received, std::vector{UTime{6'000'000}});
}

TEST_F(BusTest, LosesNothingOfAHundredThousandMessagesInOneInstant) {
  listen();
  for (int i = 1; i <= 100'000; ++i) bus.publish(kChannel, goal(i));
  const ChannelCounters counters = settle();
  EXPECT_EQ(counters.received, 100'000);
  EXPECT_EQ(counters.lost, 0);
}

}  // namespace
}  // namespace tern
