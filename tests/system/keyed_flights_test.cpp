// Whole flights with keys, on virtual time, under packets that decide a flight without keys.
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>

#include "campaign/virtual_system.h"
#include "core/wire/message_limits.h"
#include "messages/codec.h"
#include "messages/trailer.h"
#include "monitor/flight_watch.h"
#include "runtime/authentication.h"
#include "simulator/app/simulator_node.h"
#include "tests/support/watched_flight.h"

namespace tern::testing {
namespace {

constexpr char kObstacles[] =
    "world.obstacles=[{motion: trefoil, centre: [8, 0.5, 1], slowness: 1.1},"
    "{centre: [14, -1, 2], half_extents: [0.2, 0.2, 4]}, {motion: trefoil, centre: [22, -0.5, 2], slowness: 1.1, "
    "phase: 2}]";

/// Half of the largest number: an honest sender never follows it.
constexpr std::int64_t kHuge = std::int64_t{1} << 62;

/// The newest true message of each channel as bytes, and all messages of some channels.
struct Overheard {
  std::map<std::string, Bytes, std::less<>> newest;
  std::vector<std::pair<std::string, Bytes>> flown;  ///< PLAN and UAV_STATE: the flown flight

  template <class T>
  [[nodiscard]] T last(const char* channel) const {
    return decode<T>(newest.at(channel)).value();
  }
};

struct Forged {
  const char* channel;
  Bytes bytes;
};

/// A message that a listener could forge, without a trailer.
struct Attack {
  const char* name;
  std::function<std::vector<Forged>(const Overheard&, UTime now)> forge;
};

TrackSet empty_set(const char* channel, const Overheard& true_ones, UTime now, std::int64_t epoch) {
  TrackSet set = true_ones.last<TrackSet>(channel);
  set.header = {{epoch, kHuge}, now};
  set.batch = {kHuge, 0, 1};
  set.tracks.clear();
  return set;
}

std::vector<Forged> forged_plan(const Overheard& true_ones, UTime now) {
  HorizonRequest request = true_ones.last<HorizonRequest>(channels::kHorizonRequest.name);
  request.header.name.sequence = kHuge;
  Plan plan = true_ones.last<Plan>(channels::kPlan.name);
  plan.header = {{plan.header.name.sender_epoch_us, plan.header.name.sequence + 1}, now};
  return {{channels::kHorizonRequest.name, encode(request)}, {channels::kPlan.name, encode(plan)}};
}

Bytes goal_bytes(GoalMode mode, std::int64_t id, const Vec3& position, UTime now) {
  Goal goal;
  goal.header = {{now.us, 1}, now};
  goal.mode = mode;
  goal.id = id;
  goal.position = position;
  return encode(goal);
}

std::vector<Attack> attacks() {
  return {
      {"empty predictions from the future",
       [](const Overheard& o, UTime now) -> std::vector<Forged> {
         TrackSet set = empty_set(channels::kPredictions.name, o, now, 3'999'999'999'999'999);
         set.made_at = now + Duration{1'000'000'000'000};
         return {{channels::kPredictions.name, encode(set)}};
       }},
      {"half a set of predictions",
       [](const Overheard& o, UTime now) -> std::vector<Forged> {
         const auto epoch = o.last<TrackSet>(channels::kPredictions.name).header.name.sender_epoch_us;
         TrackSet set = empty_set(channels::kPredictions.name, o, now, epoch);
         set.batch.count = 2;
         return {{channels::kPredictions.name, encode(set)}};
       }},
      {"no declared motions",
       [](const Overheard& o, UTime now) -> std::vector<Forged> {
         return {{channels::kDeclaredMotions.name, encode(empty_set(channels::kDeclaredMotions.name, o, now, now.us))}};
       }},
      {"a request of a huge number, and a plan", forged_plan},
      {"stop for ever",
       [](const Overheard&, UTime now) -> std::vector<Forged> {
         return {{channels::kGoal.name, goal_bytes(GoalMode::Stop, kMaxGoalId, {0, 0, 0}, now)}};
       }},
      {"a goal that cannot be reached",
       [](const Overheard&, UTime now) -> std::vector<Forged> {
         return {{channels::kGoal.name, goal_bytes(GoalMode::Go, now.us, {1e6, 1e6, 1e6}, now)}};
       }},
      {"reached",
       [](const Overheard&, UTime now) -> std::vector<Forged> {
         FlightResult result;
         result.header = {{now.us, 1}, now};
         result.outcome = FlightOutcome::Reached;
         result.min_clearance_m = 1.0;
         return {{channels::kFlightResult.name, encode(result)}};
       }},
      {"a simulator that starts anew",
       [](const Overheard&, UTime now) -> std::vector<Forged> {
         Heartbeat beat;
         beat.header = {{now.us, 1}, now};
         beat.process = "tern-simulator";
         beat.state = ProcessState::Ready;
         return {{channels::kHeartbeat.name, encode(beat)}};
       }},
      {"requests of another vehicle",
       [](const Overheard& o, UTime now) -> std::vector<Forged> {
         HorizonRequest request = o.last<HorizonRequest>(channels::kHorizonRequest.name);
         request.header = {{now.us, 1}, now};
         return {{channels::kHorizonRequest.name, encode(request)}};
       }},
  };
}

class KeyedFlight {
 public:
  explicit KeyedFlight(const std::optional<Key>& master)
      : system_(scenario_file("paper_corridor"),
                {"world.generator=none", "world.count=0", kObstacles, "uav.goal=[30, 0, 2]", "executor.rate_hz=10"},
                Charge::Counts, UTime{1'000'000}, master),
        watch_(system_.scenario(), now()) {
    Bus& bus = system_.runner().observer();
    bus.listen([this](std::string_view channel, std::int64_t, std::span<const std::uint8_t> data) {
      if (forging_) return;
      Bytes bytes(data.begin(), data.end());
      if (channel == channels::kPlan.name || channel == channels::kUavState.name)
        heard.flown.emplace_back(channel, bytes);
      heard.newest.insert_or_assign(std::string(channel), std::move(bytes));
    });
    bus.subscribe(channels::kHeartbeat, [this](const Heartbeat& m) { watch_.receive(m, now()); });
    bus.subscribe(channels::kHorizonRequest, [this](const HorizonRequest& m) { watch_.receive(m, now()); });
    bus.subscribe(channels::kFlightResult, [this](const FlightResult& m) { watch_.receive(m, now()); });
  }

  [[nodiscard]] UTime now() { return system_.runner().now(); }
  [[nodiscard]] bool flies() { return system_.simulator().world_zero().has_value(); }
  void fly(Duration span) { system_.runner().run(now() + span); }
  /// Runs until the monitor's watch has its verdict, and returns it.
  std::optional<Ending> fly_to_the_end() {
    std::optional<Ending> ending;
    system_.runner().run(now() + Duration{120'000'000}, [&] { return (ending = watch_.ending(now())).has_value(); });
    return ending;
  }
  void start_flying() {
    system_.runner().run(now() + Duration{20'000'000}, [this] { return flies(); });
    fly(Duration{1'000'000});
  }
  /// Delivers these messages at once.
  void say(const std::vector<Forged>& messages) {
    forging_ = true;
    for (const auto& [channel, bytes] : messages) {
      system_.runner().network().publish(channel, bytes.data(), static_cast<unsigned>(bytes.size()));
    }
    system_.runner().run(now());
    forging_ = false;
  }
  [[nodiscard]] const FlightResult& result() { return *system_.simulator().result(); }
  /// Returns the sum over all processes, from their last heartbeats.
  std::int64_t refused(Rejection reason) {
    std::int64_t sum = 0;
    for (const auto& [name, counters] : system_.runner().observer().counters()) {
      sum += counters.rejected[static_cast<int>(reason)];
    }
    return sum;
  }

  Overheard heard;

 private:
  VirtualSystem system_;
  FlightWatch watch_;
  bool forging_ = false;
};

/// The same message signed with another key, and with the tag of a true message.
std::vector<Forged> with_tags(const std::vector<Forged>& forged, const Overheard& true_ones, UTime now) {
  const KeyRing other = KeyRing::derive(derive_key(random_key(), "other"), "tern-forger");
  std::vector<Forged> all;
  for (const Forged& message : forged) {
    all.push_back(message);
    Bytes signed_bytes = message.bytes;
    sign(signed_bytes, other, message.channel, message.channel, {{now.us, 1}, now});
    if (const auto role = role_of(message.channel)) {
      signed_bytes[signed_bytes.size() - kTrailerBytes + 5] = static_cast<std::uint8_t>(*role);
    }
    all.push_back({message.channel, signed_bytes});
    const auto true_one = true_ones.newest.find(message.channel);
    if (true_one == true_ones.newest.end()) continue;
    Bytes stolen = message.bytes;
    stolen.insert(stolen.end(), true_one->second.end() - kTrailerBytes, true_one->second.end());
    all.push_back({message.channel, stolen});
  }
  return all;
}

const Key& flight_key() {
  static const Key kKey = random_key();
  return kKey;
}

const KeyedFlight& undisturbed() {
  static KeyedFlight* flight = [] {
    auto* made = new KeyedFlight(flight_key());
    made->start_flying();
    made->fly_to_the_end();
    return made;
  }();
  return *flight;
}

TEST(KeyedFlights, ReachTheirGoalAndFlyAsWithoutKeys) {
  KeyedFlight with(flight_key()), without(std::nullopt);
  for (KeyedFlight* flight : {&with, &without}) {
    flight->start_flying();
    const auto ending = flight->fly_to_the_end();
    ASSERT_TRUE(ending);
    EXPECT_EQ(ending->outcome, FlightOutcome::Reached) << ending->detail;
    expect_reached(flight->result());
    EXPECT_EQ(flight->refused(Rejection::Unauthenticated), 0);
    EXPECT_EQ(flight->refused(Rejection::Repeated), 0);
  }
  ASSERT_EQ(with.heard.flown.size(), without.heard.flown.size());
  for (std::size_t k = 0; k < with.heard.flown.size(); ++k) {
    auto [channel, bytes] = with.heard.flown[k];
    ASSERT_TRUE(read_trailer(bytes));
    bytes.resize(bytes.size() - kTrailerBytes);
    ASSERT_EQ(bytes, without.heard.flown[k].second) << channel << " " << k;
  }
}

TEST(KeyedFlights, ForgedPacketsChangeNotOneByteOfTheFlightAndAreCounted) {
  KeyedFlight flight(flight_key());
  flight.start_flying();
  for (const Attack& attack : attacks()) {
    const auto forged = attack.forge(flight.heard, flight.now());
    flight.say(with_tags(forged, flight.heard, flight.now()));
    flight.fly(Duration{310'000});
  }
  const auto ending = flight.fly_to_the_end();
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->outcome, FlightOutcome::Reached) << ending->detail;
  EXPECT_EQ(flight.heard.flown, undisturbed().heard.flown);
  EXPECT_GT(flight.refused(Rejection::Unauthenticated), 0);
}

TEST(KeyedFlights, TheirOwnMessagesSaidAgainChangeNotOneByteAndAreCounted) {
  KeyedFlight flight(flight_key());
  flight.start_flying();
  for (int k = 0; k < 8; ++k) {
    std::vector<Forged> again;
    static const std::vector<const char*> kChannels = {
        channels::kPredictions.name,    channels::kHorizonRequest.name, channels::kPlan.name,
        channels::kGoal.name,           channels::kHeartbeat.name,      channels::kObstacleObservations.name,
        channels::kDeclaredMotions.name};
    const Overheard then = flight.heard;
    flight.fly(Duration{400'000});
    for (const char* channel : kChannels) again.push_back({channel, then.newest.at(channel)});
    flight.say(again);
  }
  const auto ending = flight.fly_to_the_end();
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->outcome, FlightOutcome::Reached) << ending->detail;
  EXPECT_EQ(flight.heard.flown, undisturbed().heard.flown);
  EXPECT_GT(flight.refused(Rejection::Repeated), 0);
}

}  // namespace
}  // namespace tern::testing
