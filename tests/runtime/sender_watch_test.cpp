// One sender is accepted at a time, and a second one is reported.
#include "runtime/sender_watch.h"

#include <gtest/gtest.h>

#include "messages/channels.h"

namespace tern {
namespace {

constexpr UTime kStart{1'000'000'000};
constexpr Duration kPeriod{50'000};

/// PREDICTIONS, as a planner hears them.
class SenderWatchTest : public testing::Test {
 protected:
  /// The next message of a sender. @return whether it is handed on.
  bool speak(std::int64_t epoch_us) { return !watch.judge({epoch_us, ++sent[epoch_us]}, now, now, 0); }
  /// Both senders publish for a while. @return whether all messages of the first, and of the second, were accepted.
  std::pair<bool, bool> speak_beside(std::int64_t one, std::int64_t other, double seconds) {
    std::pair<bool, bool> heard{true, true};
    for (const UTime end = now + Duration::from_seconds(seconds); now < end; now = now + kPeriod) {
      heard.first = speak(one) && heard.first;
      heard.second = speak(other) && heard.second;
    }
    return heard;
  }
  void alone(std::int64_t epoch_us, double seconds) {
    for (const UTime end = now + Duration::from_seconds(seconds); now < end; now = now + kPeriod) speak(epoch_us);
  }

  UTime now = kStart;
  SenderWatch watch{sender_silence(channels::kPredictions.name)};
  std::map<std::int64_t, std::int64_t> sent;
};

TEST_F(SenderWatchTest, TheOneHeardFirstStaysWhoeverStartedLater) {
  for (const std::int64_t other : {5, 900}) {
    alone(100, 1.0);
    const auto [first, second] = speak_beside(100, other, 2.0);
    EXPECT_TRUE(first);
    EXPECT_FALSE(second);
    EXPECT_TRUE(watch.has_second_sender(now));
    alone(100, 2.5);
    EXPECT_FALSE(watch.has_second_sender(now)) << "it is over";
  }
}

TEST_F(SenderWatchTest, TheOtherIsHeardOnceTheFirstIsSilentOlderOrNot) {
  for (const std::int64_t other : {5, 900}) {
    alone(100, 1.0);
    alone(other, 0.3);
    EXPECT_TRUE(speak(other)) << other;
    now = now + Duration{1'000'000};
  }
}

TEST_F(SenderWatchTest, NoiseOfManyEpochsIsNoSecondSender) {
  for (std::int64_t k = 0; k < 1'000; ++k) {
    EXPECT_TRUE(speak(100));
    EXPECT_FALSE(speak(1'000 + k));
    now = now + kPeriod;
  }
  EXPECT_FALSE(watch.has_second_sender(now));
}

TEST_F(SenderWatchTest, ALogThatIsPlayedAgainIsHeardAgain) {
  alone(100, 1.0);
  now = now + Duration{10'000'000};
  sent.clear();
  for (int k = 0; k < 10; ++k) {
    EXPECT_TRUE(speak(100));
    now = now + kPeriod;
  }
  EXPECT_EQ(watch.lost(), 0);
}

TEST(SpeakerSilence, SensorsGoalsAndReportsMayComeFromSeveral) {
  for (const char* channel : {channels::kObstacleObservations.name, channels::kGoal.name, channels::kHeartbeat.name,
                              channels::kConfiguration.name}) {
    EXPECT_FALSE(sender_silence(channel)) << channel;
  }
  for (const char* channel :
       {channels::kDeclaredMotions.name, channels::kUavState.name, channels::kFlightResult.name}) {
    EXPECT_EQ(sender_silence(channel), Duration{1'000'000}) << channel;
  }
}

}  // namespace
}  // namespace tern
