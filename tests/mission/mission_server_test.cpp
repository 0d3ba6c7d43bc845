// Uploads, downloads and orders of a ground station.
#include "mission/upload/mission_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/mission/some_site.h"
#include "tests/support/effort.h"

namespace tern::mission {
namespace {

using namespace mavlink;
using testing::some_site;

constexpr Address kVehicle{7, 1}, kStation{255, 190}, kOther{254, 190};

MissionItemInt waypoint(std::uint16_t seq, double latitude, double longitude, float altitude) {
  MissionItemInt item;
  item.seq = seq;
  item.command = 16;
  item.frame = 6;
  item.autocontinue = 1;
  item.param[3] = std::numeric_limits<float>::quiet_NaN();
  item.x = static_cast<std::int32_t>(std::lround(latitude * 1e7));
  item.y = static_cast<std::int32_t>(std::lround(longitude * 1e7));
  item.z = altitude;
  item.target_system = kVehicle.system;
  item.target_component = kVehicle.component;
  return item;
}

class Server : public ::testing::Test {
 protected:
  Server()
      : server_(kVehicle, {[this](const std::vector<Item>& items) {
                             taken_ = items;
                             return refusal_;
                           },
                           [this](Order order) {
                             orders_.push_back(order);
                             return refusal_;
                           },
                           [this] { ++awaited_; },
                           [this](const std::vector<MissionItemInt>& items) {
                             fences_ = items;
                             return refusal_;
                           },
                           ""}) {}

  template <class M>
  std::vector<Frame> send(const M& message, Address from = kStation) {
    return server_.receive(to_frame(message, from, 0), now_);
  }
  std::vector<Frame> count(std::uint16_t items, std::uint8_t type = 0, Address from = kStation) {
    return send(MissionCount{items, kVehicle.system, kVehicle.component, type, 0}, from);
  }
  /// The only answer, as a message of this type.
  template <class M>
  static M only(const std::vector<Frame>& frames) {
    EXPECT_EQ(frames.size(), 1u);
    const auto message = frames.empty() ? std::nullopt : from_frame<M>(frames.back());
    EXPECT_TRUE(message.has_value());
    return message.value_or(M{});
  }
  static std::uint8_t result(const std::vector<Frame>& frames) { return from_frame<MissionAck>(frames.back())->type; }
  void upload(int items) {
    count(static_cast<std::uint16_t>(items));
    for (int k = 0; k < items; ++k) send(waypoint(static_cast<std::uint16_t>(k), 47.398 + 1e-4 * k, 8.5456, 10.0F));
  }

  void upload_fences(int items) {
    count(static_cast<std::uint16_t>(items), kFenceType);
    for (int k = 0; k < items; ++k) send(fence(static_cast<std::uint16_t>(k)));
  }
  static MissionItemInt fence(std::uint16_t seq) {
    MissionItemInt item = waypoint(seq, 47.398, 8.5456, 0.0F);
    item.command = 5004;
    item.mission_type = kFenceType;
    return item;
  }

  std::vector<Item> taken_;
  std::vector<MissionItemInt> fences_;
  int awaited_ = 0;
  std::vector<Order> orders_;
  std::string refusal_;
  UTime now_{1'000'000};
  MissionServer server_;
};

TEST_F(Server, AsksForEachItemAndTakesTheMission) {
  EXPECT_EQ(only<MissionRequestInt>(count(2)).seq, 0);
  EXPECT_EQ(only<MissionRequestInt>(send(waypoint(0, 47.398, 8.5456, 10.0F))).seq, 1);
  EXPECT_EQ(only<MissionAck>(send(waypoint(1, 47.399, 8.5456, 12.0F))).type, kAccepted);
  ASSERT_EQ(taken_.size(), 2u);
  EXPECT_EQ(taken_[1].number, 2);
  const auto steps = steps_of(taken_, some_site()).value();
  const Vec3 place = some_site().frame->to_world({47.399, 8.5456, 500.0});
  EXPECT_LT((steps[1].position - place).norm(), 0.01);  // a unit of 1e-7 degrees is 1.1 cm
}

TEST_F(Server, AsksAgainForWhatWasLostAndDropsASilentUpload) {
  count(2);
  EXPECT_EQ(only<MissionRequestInt>(send(waypoint(1, 47.399, 8.5456, 12.0F))).seq, 0);
  EXPECT_TRUE(server_.step(now_).empty());
  for (int k = 2; k < kTries; ++k) {
    now_ = now_ + kRequestAgain;
    EXPECT_EQ(only<MissionRequestInt>(server_.step(now_)).seq, 0) << k;
  }
  now_ = now_ + kRequestAgain;
  EXPECT_EQ(only<MissionAck>(server_.step(now_)).type, kCancelled);
  EXPECT_TRUE(send(waypoint(0, 47.399, 8.5456, 12.0F)).empty());
  EXPECT_TRUE(taken_.empty());
}

TEST_F(Server, AcknowledgesAgainIfTheLastItemComesAgain) {
  upload(2);
  taken_.clear();
  EXPECT_EQ(only<MissionAck>(send(waypoint(1, 47.399, 8.5456, 12.0F))).type, kAccepted);
  EXPECT_TRUE(taken_.empty()) << "it is in force already";
  EXPECT_TRUE(send(waypoint(0, 47.399, 8.5456, 12.0F)).empty());
  EXPECT_TRUE(send(waypoint(1, 47.399, 8.5456, 12.0F), kOther).empty());
  send(MissionClearAll{kVehicle.system, kVehicle.component, 0});
  EXPECT_TRUE(send(waypoint(1, 47.399, 8.5456, 12.0F)).empty()) << "it is in force no more";
  refusal_ = "no";
  upload(1);
  EXPECT_EQ(only<MissionAck>(send(waypoint(0, 47.399, 8.5456, 12.0F))).type, kInvalid);
}

TEST_F(Server, NamesWhyAMissionIsRefused) {
  refusal_ = "item 2, MAV_CMD_NAV_SPLINE_WAYPOINT (82): cannot be flown; convert the mission to single waypoints";
  count(1);
  const auto answers = send(waypoint(0, 47.399, 8.5456, 12.0F));
  ASSERT_EQ(answers.size(), 3u);
  EXPECT_EQ(string_of(from_frame<StatusText>(answers[0])->text) + string_of(from_frame<StatusText>(answers[1])->text),
            refusal_);
  EXPECT_EQ(result(answers), kInvalid);
  EXPECT_TRUE(server_.items().empty());
}

TEST_F(Server, ReturnsWhatWasUploaded) {
  upload(3);
  EXPECT_EQ(only<MissionCount>(send(MissionRequestList{kVehicle.system, kVehicle.component, 0})).count, 3);
  const auto item = only<MissionItemInt>(send(MissionRequestInt{2, kVehicle.system, kVehicle.component, 0}));
  EXPECT_EQ(item.x, waypoint(2, 47.3982, 8.5456, 10.0F).x);
  EXPECT_EQ(item.target_system, kStation.system);
  EXPECT_EQ(result(send(MissionRequestInt{3, kVehicle.system, kVehicle.component, 0})), kInvalidSequence);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 0})), kAccepted);
  EXPECT_TRUE(taken_.empty());
}

TEST_F(Server, NamesThatRallyPointsAreNotTaken) {
  const auto answers = count(2, 2);
  EXPECT_EQ(result(answers), kUnsupported);
  EXPECT_EQ(from_frame<MissionAck>(answers.back())->mission_type, 2);
  EXPECT_THAT(string_of(from_frame<StatusText>(answers.front())->text), ::testing::HasSubstr("rally points cannot"));
  EXPECT_EQ(only<MissionAck>(send(MissionRequestList{kVehicle.system, kVehicle.component, 2})).type, kUnsupported);
  EXPECT_EQ(only<MissionAck>(send(MissionRequestInt{0, kVehicle.system, kVehicle.component, 2})).type, kUnsupported);
  EXPECT_EQ(result(count(0, 2)), kAccepted);
}

TEST_F(Server, NamesWhyFencesAreNotTakenWithoutATaker) {
  server_ = MissionServer(kVehicle, {[](const auto&) { return ""; }, [](Order) { return ""; }});
  const auto answers = count(2, kFenceType);
  EXPECT_EQ(result(answers), kUnsupported);
  EXPECT_EQ(string_of(from_frame<StatusText>(answers.front())->text), "fences cannot be uploaded");
  EXPECT_EQ(only<MissionAck>(send(MissionRequestList{kVehicle.system, kVehicle.component, 1})).type, kUnsupported);
  EXPECT_EQ(result(count(0, kFenceType)), kAccepted);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 255})), kAccepted);
}

TEST_F(Server, TakesReturnsAndClearsFencesBesideTheMission) {
  upload(2);
  EXPECT_EQ(awaited_, 0);
  const auto request = only<MissionRequestInt>(count(2, kFenceType));
  EXPECT_EQ(request.mission_type, kFenceType);
  EXPECT_EQ(awaited_, 1);
  EXPECT_TRUE(send(waypoint(0, 47.398, 8.5456, 10.0F)).empty()) << "of another type";
  EXPECT_EQ(only<MissionRequestInt>(send(fence(0))).mission_type, kFenceType);
  const auto ack = only<MissionAck>(send(fence(1)));
  EXPECT_EQ(ack.type, kAccepted);
  EXPECT_EQ(ack.mission_type, kFenceType);
  EXPECT_EQ(fences_.size(), 2u);
  EXPECT_EQ(only<MissionAck>(send(fence(1))).type, kAccepted) << "its acknowledgement was lost";
  EXPECT_EQ(taken_.size(), 2u);
  EXPECT_EQ(only<MissionCount>(send(MissionRequestList{kVehicle.system, kVehicle.component, 1})).count, 2);
  const auto item = only<MissionItemInt>(send(MissionRequestInt{1, kVehicle.system, kVehicle.component, 1}));
  EXPECT_EQ(item.command, 5004);
  EXPECT_EQ(item.mission_type, kFenceType);
  EXPECT_EQ(result(send(MissionRequestInt{2, kVehicle.system, kVehicle.component, 1})), kInvalidSequence);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 0})), kAccepted);
  EXPECT_EQ(server_.fences().size(), 2u);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 1})), kAccepted);
  EXPECT_TRUE(fences_.empty());
  EXPECT_TRUE(server_.fences().empty());
}

TEST_F(Server, KeepsTheFencesBeforeIfOthersAreRefused) {
  upload_fences(2);
  refusal_ = "fence item 1, MAV_CMD_NAV_WAYPOINT (16): is no fence";
  count(1, kFenceType);
  const auto answers = send(fence(0));
  EXPECT_EQ(result(answers), kInvalid);
  EXPECT_GE(answers.size(), 2u);
  EXPECT_EQ(server_.fences().size(), 2u);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 1})), kDenied);
  EXPECT_EQ(server_.fences().size(), 2u);
}

TEST_F(Server, SaysThatItTakesFences) {
  CommandLong command;
  command.target_system = kVehicle.system;
  command.command = 512;
  command.param[0] = 148.0F;
  const auto answers = send(command);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(from_frame<CommandAck>(answers[0])->result, 0);
  EXPECT_EQ(from_frame<AutopilotVersion>(answers[1])->capabilities, 4u + 8192u + 16384u);
  command.param[0] = 300.0F;
  EXPECT_EQ(only<CommandAck>(send(command)).result, 3);
}

TEST_F(Server, ClearsTheMissionIfAllTypesAreCleared) {
  upload(2);
  EXPECT_EQ(taken_.size(), 2u);
  upload_fences(1);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 2})), kAccepted);
  EXPECT_EQ(server_.items().size(), 2u);
  EXPECT_EQ(result(send(MissionClearAll{kVehicle.system, kVehicle.component, 255})), kAccepted);
  EXPECT_TRUE(taken_.empty());
  EXPECT_TRUE(server_.items().empty());
  EXPECT_TRUE(server_.fences().empty());
}

TEST_F(Server, DeniesAPartOfAMission) {
  upload(3);
  CommandLong command;
  command.target_system = kVehicle.system;
  command.command = 300;
  const auto start = [&](float first, float last) {
    command.param[0] = first;
    command.param[1] = last;
    return from_frame<CommandAck>(send(command).back())->result;
  };
  EXPECT_EQ(start(1, 0), 2);
  EXPECT_EQ(start(0, 1), 2);
  EXPECT_TRUE(orders_.empty());
  EXPECT_EQ(start(0, 2), 0);
  EXPECT_EQ(start(0, 0), 0);
}

TEST_F(Server, RefusesOtherStationsOtherVehiclesAndTooManyItems) {
  count(2);
  EXPECT_EQ(result(count(2, 0, kOther)), kDenied);
  EXPECT_EQ(result(count(2, 1, kOther)), kDenied);
  EXPECT_TRUE(send(waypoint(0, 47.399, 8.5456, 12.0F), kOther).empty());
  EXPECT_TRUE(send(MissionCount{2, 9, 1, 0, 0}).empty());
  EXPECT_EQ(result(count(2'001, 0)), kNoSpace);
  EXPECT_EQ(result(count(2'001, 1)), kNoSpace);
}

TEST_F(Server, PassesOrdersOn) {
  CommandLong command;
  command.target_system = kVehicle.system;
  for (const std::uint16_t id : std::initializer_list<std::uint16_t>{300, 193, 400}) {
    command.command = id;
    const auto ack = only<CommandAck>(send(command));
    EXPECT_EQ(ack.command, id);
    EXPECT_EQ(ack.result, id == 400 ? 3 : 0);
  }
  command.command = 193;
  command.param[0] = 1.0F;
  send(command);
  EXPECT_THAT(orders_, ::testing::ElementsAre(Order::Start, Order::Pause, Order::GoOn));
}

TEST_F(Server, ADownloadedMissionIsTheOneThatIsFlown) {
  auto steps = steps_of({item_of(waypoint(0, 47.398, 8.5456, 10.0F)), item_of(waypoint(1, 47.399, 8.5457, 12.0F)),
                         item_of(waypoint(2, 47.399, 8.5458, 12.0F)), item_of(waypoint(3, 47.398, 8.5458, 12.0F))},
                        some_site())
                   .value();
  steps[1].speed = steps[2].speed = 1.5;
  std::vector<Item> again;
  for (const MissionItemInt& item : items_of(steps, some_site())) again.push_back(item_of(item));
  const auto back = steps_of(again, some_site()).value();
  ASSERT_EQ(back.size(), steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    EXPECT_LT((back[k].position - steps[k].position).norm(), 0.02);
    EXPECT_EQ(back[k].speed, steps[k].speed);
  }
  EXPECT_THAT(seqs_of(steps), ::testing::ElementsAre(0, 2, 3, 5)) << "two items change the speed";
}

TEST_F(Server, AnyFramesGetAnswersOrNone) {
  Rng rng(4);
  const auto byte = [&] { return static_cast<std::uint8_t>(rng.uniform(0, 256)); };
  constexpr std::uint32_t kIds[] = {40, 43, 44, 45, 47, 51, 73, 76, 0};
  for (int k = 0; k < support::at_effort(10'000); ++k) {
    Frame frame;
    frame.id = kIds[static_cast<std::size_t>(rng.uniform(0, std::size(kIds)))];
    frame.from = {byte(), byte()};
    frame.payload.resize(form_of(frame.id)->length);
    for (auto& b : frame.payload) b = rng.uniform() < 0.5 ? std::uint8_t{0} : byte();
    ASSERT_LE(server_.receive(frame, now_).size(), 12u);
    now_ = now_ + Duration{100'000};
    (void)server_.step(now_);
  }
}

}  // namespace
}  // namespace tern::mission
