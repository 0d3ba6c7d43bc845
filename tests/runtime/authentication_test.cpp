// Signed messages: valid tags, invalid tags, repeated messages.
#include "runtime/authentication.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <numeric>
#include <random>
#include <set>

#include "messages/codec.h"
#include "messages/trailer.h"
#include "runtime/bus.h"
#include "runtime/lcm_network.h"

namespace tern {
namespace {

Key counting_key() {
  std::array<std::uint8_t, kKeyBytes> bytes;
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return Key(bytes);
}

Bytes text(const char* t) { return {t, t + std::string_view(t).size()}; }

TEST(Signature, HasTheBytesThatPythonMakes) {
  // k = blake2b(b"tern key 1 PLAN", key=bytes(range(32)), digest_size=32).digest()
  // blake2b(b"\x06PLAN_2" + b"message" + head, key=k, digest_size=16)
  Bytes message = text("message");
  sign(message, KeyRing::derive(counting_key(), "tern-planner"), "PLAN", "PLAN_2", {{1'000, 5}, UTime{2'000}});
  ASSERT_EQ(message.size(), 7 + kTrailerBytes);
  const Tag expected = {0x00, 0x72, 0xc6, 0xe7, 0x23, 0x05, 0x51, 0xd8, 0x23, 0x15, 0x75, 0xd8, 0x74, 0x56, 0x8d, 0xf9};
  EXPECT_EQ(read_trailer(message)->tag, expected);
}

class SignedMessage : public testing::Test {
 protected:
  SignedMessage() { sign(message, planner, "PLAN", "PLAN", {{1'000'000, 1}, now}); }
  tl::expected<VerifiedMessage, Rejection> check(const Bytes& bytes, const char* channel = "PLAN",
                                                 const char* wire_name = "PLAN") {
    return verify(bytes, executor, guard, channel, wire_name, now);
  }
  UTime now{5'000'000};
  KeyRing planner = KeyRing::derive(counting_key(), "tern-planner");
  KeyRing executor = KeyRing::derive(counting_key(), "tern-executor");
  ReplayGuard guard;
  Bytes message = text("a message");
};

TEST_F(SignedMessage, IsHandedOverWithoutItsTrailer) {
  const auto authentic = check(message);
  ASSERT_TRUE(authentic);
  EXPECT_EQ(Bytes(authentic->message.begin(), authentic->message.end()), text("a message"));
  EXPECT_EQ(authentic->role, Role::Planner);
}

TEST_F(SignedMessage, HoldsNoLongerWithAnyBitChangedOrAnyByteMissing) {
  for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
    Bytes changed = message;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    const auto refused = check(changed);
    ASSERT_FALSE(refused) << bit;
    EXPECT_EQ(refused.error(), Rejection::Unauthenticated) << bit;
  }
  for (std::size_t n = 0; n < message.size(); ++n) {
    EXPECT_FALSE(check(Bytes(message.begin(), message.begin() + static_cast<int>(n)))) << n;
    EXPECT_FALSE(check(Bytes(message.begin() + 1 + static_cast<int>(n), message.end()))) << n;
  }
  EXPECT_TRUE(check(message)) << "what was refused used no number up";
}

TEST_F(SignedMessage, HoldsOnItsOwnChannelAndVehicleOnly) {
  EXPECT_FALSE(check(message, "PLAN_TIMING", "PLAN_TIMING"));
  EXPECT_FALSE(check(message, "GOAL", "GOAL"));
  EXPECT_FALSE(check(message, "PLAN", "PLAN_2"));
  EXPECT_TRUE(check(message));
}

TEST_F(SignedMessage, OfAnotherRoleOrFlightDoesNotHold) {
  Key other = derive_key(counting_key(), "another flight");
  Bytes forged = text("a message");
  sign(forged, KeyRing::derive(other, "tern-planner"), "PLAN", "PLAN", {{1'000'000, 1}, now});
  EXPECT_FALSE(check(forged));
  const KeyRing predictor = KeyRing::derive(counting_key(), "tern-predictor");
  Bytes of_predictor = text("a message");
  EXPECT_THROW(sign(of_predictor, predictor, "PLAN", "PLAN", {{1'000'000, 1}, now}), std::invalid_argument);
  // A predictor has no key for PLAN: it signs with its key for PREDICTIONS.
  sign(of_predictor, predictor, "PREDICTIONS", "PLAN", {{1'000'000, 1}, now});
  EXPECT_FALSE(check(of_predictor));
  of_predictor[of_predictor.size() - kTrailerBytes + 5] = static_cast<std::uint8_t>(Role::Planner);
  EXPECT_FALSE(check(of_predictor));
}

TEST_F(SignedMessage, CountsOnceAndNotWhenItIsOld) {
  EXPECT_TRUE(check(message));
  const auto again = check(message);
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error(), Rejection::Repeated);
  ReplayGuard fresh;  // a receiver that has just started
  const auto late = verify(message, executor, fresh, "PLAN", "PLAN", now + kMaxTransit + Duration{1});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error(), Rejection::Repeated);
  EXPECT_TRUE(verify(message, executor, fresh, "PLAN", "PLAN", now + kMaxTransit));
}

TEST(ReplayWindow, AdmitsWhatASetOfAllThatCameWouldWithinItsReach) {
  std::mt19937 random(11);
  for (int draw = 0; draw < 200; ++draw) {
    ReplayWindow window;
    std::set<std::int64_t> seen;
    std::int64_t highest = 0;
    std::int64_t sent = 1;
    for (int k = 0; k < 500; ++k) {
      sent += std::uniform_int_distribution<std::int64_t>(0, draw % 5 == 0 ? 90 : 3)(random);
      const std::int64_t sequence =
          std::max<std::int64_t>(1, sent - std::uniform_int_distribution<std::int64_t>(0, 80)(random));
      const bool is_new = sequence > highest - 64 && seen.insert(sequence).second;
      highest = std::max(highest, sequence);
      ASSERT_EQ(window.admit(sequence), is_new) << sequence << " after " << highest;
    }
  }
}

TEST(ReplayWindow, BearsTheLargestNumber) {
  ReplayWindow window;
  EXPECT_TRUE(window.admit(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(window.admit(std::numeric_limits<std::int64_t>::max()));
  EXPECT_FALSE(window.admit(1));
}

TEST(ReplayGuard, KeepsSendersApartAndForgetsTheOneNotHeardLongest) {
  ReplayGuard guard;
  for (std::int64_t epoch = 1; epoch <= 1'000; ++epoch) {
    EXPECT_TRUE(guard.touch({Role::Planner, epoch}).admit(1));
    EXPECT_FALSE(guard.touch({Role::Planner, epoch}).admit(1));
    EXPECT_EQ(guard.touch({Role::Planner, 1}).admit(1), false) << "heard all along, so still known";
  }
  EXPECT_TRUE(guard.touch({Role::Mapper, 1}).admit(1));
}

/// A network within the test: `simulator` listens with keys; others speak with, without, or with wrong ones.
class KeyedBus : public testing::Test {
 protected:
  KeyedBus() {
    simulator.subscribe(channels::kGoal, [this](const Goal& g) { goals.push_back(g); });
    simulator.subscribe(channels::kHeartbeat, [this](const Heartbeat& h) { beats.push_back(h); });
  }
  static std::optional<KeyRing> ring(const char* process, const Key& master = counting_key()) {
    return KeyRing::derive(master, process);
  }
  Goal goal(std::int64_t id) {
    Goal g;
    g.id = id;
    return g;
  }
  Heartbeat beat(const std::string& process) {
    Heartbeat h;
    h.process = process;
    return h;
  }
  std::int64_t rejected(const char* channel, Rejection reason) {
    drain(*lcm, 1'000'000);
    simulator.rethrow();
    return simulator.counters()[channel].rejected[static_cast<int>(reason)];
  }
  /// Records the bytes on GOAL, to send them again.
  void overhear(std::vector<Bytes>& all) {
    simulator.listen([&all](std::string_view name, std::int64_t, std::span<const std::uint8_t> bytes) {
      if (name == channels::kGoal.name) all.emplace_back(bytes.begin(), bytes.end());
    });
  }

  std::shared_ptr<lcm::LCM> lcm = std::make_shared<lcm::LCM>("memq://");
  VirtualClock clock{UTime{5'000'000}};
  Bus simulator{lcm, clock, 1'000, "", ring("tern-simulator")};
  Bus viewer{lcm, clock, 2'000, "", ring("tern-viewer")};
  std::vector<Goal> goals;
  std::vector<Heartbeat> beats;
};

TEST_F(KeyedBus, HearsWhoHasTheKey) {
  viewer.publish(channels::kGoal, goal(1));
  simulator.publish(channels::kGoal, goal(2));
  EXPECT_EQ(rejected(channels::kGoal.name, Rejection::Unauthenticated), 0);
  ASSERT_EQ(goals.size(), 2U);
  EXPECT_EQ(goals[0].id, 1);
}

TEST_F(KeyedBus, CountsWhatHasNoTagOrAWrongOneAndHandsItToNobody) {
  Bus without{lcm, clock, 3'000};
  Bus of_another_flight{lcm, clock, 4'000, "", ring("tern-viewer", derive_key(counting_key(), "other"))};
  without.publish(channels::kGoal, goal(1));
  of_another_flight.publish(channels::kGoal, goal(2));
  lcm->publish(channels::kGoal.name, "", 0);
  EXPECT_EQ(rejected(channels::kGoal.name, Rejection::Unauthenticated), 3);
  EXPECT_TRUE(goals.empty());
}

TEST_F(KeyedBus, AProcessWithoutKeysPassesTrailersOver) {
  Bus without{lcm, clock, 3'000};
  std::vector<Goal> heard;
  without.subscribe(channels::kGoal, [&](const Goal& g) { heard.push_back(g); });
  viewer.publish(channels::kGoal, goal(7));
  drain(*lcm, 100);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].id, 7);
}

TEST_F(KeyedBus, ADuplicatedDatagramCountsOnceAReorderedOneCounts) {
  std::vector<Bytes> said;
  overhear(said);
  for (int id = 1; id <= 3; ++id) viewer.publish(channels::kGoal, goal(id));
  EXPECT_EQ(rejected(channels::kGoal.name, Rejection::Repeated), 0);
  for (const Bytes& bytes : std::vector<Bytes>(said))
    lcm->publish(channels::kGoal.name, bytes.data(), static_cast<unsigned>(bytes.size()));
  EXPECT_EQ(rejected(channels::kGoal.name, Rejection::Repeated), 3);
  EXPECT_EQ(goals.size(), 3U);

  Bus late{lcm, clock, 6'000, "", ring("tern-simulator")};
  std::vector<std::int64_t> order;
  late.subscribe(channels::kGoal, [&](const Goal& g) { order.push_back(g.id); });
  for (const int k : {0, 2, 1})
    lcm->publish(channels::kGoal.name, said[static_cast<std::size_t>(k)].data(),
                 static_cast<unsigned>(said[static_cast<std::size_t>(k)].size()));
  drain(*lcm, 100);
  EXPECT_EQ(order, (std::vector<std::int64_t>{1, 3, 2}));
}

TEST_F(KeyedBus, AMessageOfThisFlightSaidAgainLaterIsRefusedAlsoByWhoHasJustStarted) {
  std::vector<Bytes> said;
  overhear(said);
  viewer.publish(channels::kGoal, goal(1));
  drain(*lcm, 100);
  clock.advance_to(clock.now() + kMaxTransit + Duration{1});
  Bus restarted{lcm, clock, 7'000, "", ring("tern-simulator")};
  restarted.subscribe(channels::kGoal, [](const Goal&) { ADD_FAILURE() << "heard"; });
  lcm->publish(channels::kGoal.name, said[0].data(), static_cast<unsigned>(said[0].size()));
  drain(*lcm, 100);
  EXPECT_EQ(restarted.counters()[channels::kGoal.name].rejected[static_cast<int>(Rejection::Repeated)], 1);
}

TEST_F(KeyedBus, NobodySpeaksForAnotherRolesProcessOnHeartbeat) {
  Bus predictor{lcm, clock, 3'000, "", ring("tern-predictor")};
  predictor.publish(channels::kHeartbeat, beat("tern-simulator"));
  predictor.publish(channels::kHeartbeat, beat("tern-planner"));
  EXPECT_EQ(rejected(channels::kHeartbeat.name, Rejection::Unauthenticated), 2);
  predictor.publish(channels::kHeartbeat, beat("tern-predictor"));
  predictor.publish(channels::kHeartbeat, beat("a-detector"));
  EXPECT_EQ(rejected(channels::kHeartbeat.name, Rejection::Unauthenticated), 2);
  ASSERT_EQ(beats.size(), 2U);
  EXPECT_EQ(beats[1].process, "a-detector");
}

TEST_F(KeyedBus, WhoHasNoKeyOfAChannelCanNeitherSayNorHearIt) {
  Bus mapper{lcm, clock, 3'000, "", ring("tern-mapper")};
  EXPECT_THROW(mapper.publish(channels::kGoal, goal(1)), std::invalid_argument);
  EXPECT_THROW(mapper.subscribe(channels::kGoal, [](const Goal&) {}), std::invalid_argument);
}

TEST_F(KeyedBus, MutatedAndRandomBytesChangeNothing) {
  std::vector<Bytes> said;
  overhear(said);
  viewer.publish(channels::kGoal, goal(1));
  drain(*lcm, 100);
  const Bytes good = said[0];
  std::mt19937 random(3);
  for (int k = 0; k < 20'000; ++k) {
    Bytes bytes = good;
    bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    if (k % 3 == 0) bytes.resize(random() % bytes.size());
    lcm->publish(channels::kGoal.name, bytes.data(), static_cast<unsigned>(bytes.size()));
    if (k % 500 == 0) drain(*lcm, 2'000);
  }
  EXPECT_EQ(rejected(channels::kGoal.name, Rejection::Unauthenticated), 20'000);
  EXPECT_EQ(simulator.counters()[channels::kGoal.name].lost, 0);
  EXPECT_EQ(goals.size(), 1U);
}

}  // namespace
}  // namespace tern
