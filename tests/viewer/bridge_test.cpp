// The parts without a scene: board, access, commands.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>

#include "viewer/bridge/access.h"
#include "viewer/bridge/board.h"
#include "viewer/bridge/commands.h"
#include "viewer/bridge/json_writer.h"
#include "viewer/bridge/subscriptions.h"

namespace tern {
namespace {

using nlohmann::json;

TEST(Board, GivesAReaderTheNewestOfEachTopicOnce) {
  Board board;
  Board::Reader reader;
  EXPECT_EQ(board.take(reader), "");
  board.post(Topic::State, "1");
  board.post(Topic::State, "2");
  board.post(Topic::Plan, "{}");
  EXPECT_EQ(json::parse(board.take(reader)), json::parse(R"({"frame":1,"dropped":0,"state":2,"plan":{}})"));
  EXPECT_EQ(board.take(reader), "");
  board.post(Topic::State, "2");
  EXPECT_EQ(board.take(reader), "");
}

TEST(Board, CountsWhatASlowReaderMissedAndAFastOneDoesNot) {
  Board board;
  Board::Reader fast, slow;
  board.post(Topic::State, "0");
  board.take(fast);
  board.take(slow);
  for (int k = 1; k <= 10; ++k) {
    board.post(Topic::State, std::to_string(k));
    EXPECT_EQ(json::parse(board.take(fast))["state"], k);
  }
  const json frame = json::parse(board.take(slow));
  EXPECT_EQ(frame["state"], 10);
  EXPECT_EQ(frame["dropped"], 9);
  EXPECT_EQ(fast.dropped, 0);
}

TEST(Access, TakesItsOwnPageOnly) {
  const Access access({"drone.lan", "192.168.1.5"});
  for (const char* host : {"localhost:8765", "127.0.0.1:8765", "LOCALHOST", "[::1]:9", "drone.lan:80", "192.168.1.5"}) {
    EXPECT_TRUE(access.allows_host(host)) << host;
    EXPECT_TRUE(access.allows_origin(std::string("http://") + host, host)) << host;
    EXPECT_TRUE(access.allows_origin("", host)) << host;
  }
  for (const char* host : {"", ":80", "evil.example", "evil.example:8765", "127.0.0.1.evil.example", "localhost.evil",
                           "127.0.0.2", "[::2]:8765", "0.0.0.0"}) {
    EXPECT_FALSE(access.allows_host(host)) << host;
  }
  for (const char* origin : {"http://evil.example", "https://localhost:8765", "null", "http://localhost:8766",
                             "http://localhost", "file://", "http://localhost:8765/"}) {
    EXPECT_FALSE(access.allows_origin(origin, "localhost:8765")) << origin;
  }
}

TEST(Commands, AreUnderstood) {
  EXPECT_TRUE(std::get<LayersCommand>(*parse_command(R"({"layers":["hulls","planes"]})")).planes);
  EXPECT_TRUE(std::get<LayersCommand>(*parse_command(R"({"layers":["tracks"]})")).tracks);
  EXPECT_EQ(std::get<PickCommand>(*parse_command(R"({"pick":{"kind":"obstacle","id":7}})")).id, 7);
  EXPECT_TRUE(std::get<PlayCommand>(*parse_command(R"({"player":{"play":true}})")).play);
  EXPECT_EQ(std::get<SeekCommand>(*parse_command(R"({"player":{"seek_us":1700000000000000}})")).at_us,
            1'700'000'000'000'000);
  EXPECT_EQ(std::get<StepCommand>(*parse_command(R"({"player":{"step":-1}})")).plans, -1);
  EXPECT_EQ(std::get<SpeedCommand>(*parse_command(R"({"player":{"speed":0.5}})")).factor, 0.5);
  EXPECT_EQ(std::get<GoalCommand>(*parse_command(R"({"goal":{"position":[1,-2,3.5]}})")).position, Vec3(1, -2, 3.5));
  EXPECT_EQ(std::get<GoalCommand>(*parse_command(R"({"goal":{"mode":"stop"}})")).mode, GoalMode::Stop);
  EXPECT_EQ(std::get<SeriesCommand>(*parse_command(R"({"series":["PLAN.hold_s"]})")).names,
            std::vector<std::string>{"PLAN.hold_s"});
}

TEST(Commands, OfAnyOtherFormAreRefused) {
  for (const char* text : {"",
                           "{",
                           "null",
                           "[]",
                           "7",
                           "{}",
                           R"({"fly":1})",
                           R"({"layers":"hulls"})",
                           R"({"layers":["walls"]})",
                           R"({"layers":[1]})",
                           R"({"layers":[],"goal":{}})",
                           R"({"series":"PLAN.hold_s"})",
                           R"({"series":[1]})",
                           R"({"pick":{}})",
                           R"({"pick":{"kind":"moon"}})",
                           R"({"pick":{"kind":"obstacle","id":1.5}})",
                           R"({"pick":{"kind":"obstacle","id":18446744073709551615}})",
                           R"({"player":{}})",
                           R"({"player":{"play":1}})",
                           R"({"player":{"play":true,"speed":1}})",
                           R"({"player":{"speed":0}})",
                           R"({"player":{"speed":1e300}})",
                           R"({"player":{"step":2}})",
                           R"({"goal":{"position":[1,2]}})",
                           R"({"goal":{"position":[1,2,1e9]}})",
                           R"({"goal":{"position":[1,2,null]}})",
                           R"({"goal":{"mode":"dive","position":[1,2,3]}})",
                           R"({"goal":{"position":[1,2,3],"speed":9}})"}) {
    EXPECT_FALSE(parse_command(text)) << text;
  }
}

TEST(Subscriptions, AreOfAllPagesThatStillLook) {
  Subscriptions subscriptions;
  subscriptions.take(1, LayersCommand{true, false, false});
  subscriptions.take(1, SeriesCommand{{"b", "a"}});
  subscriptions.take(2, LayersCommand{false, true, false});
  subscriptions.take(2, SeriesCommand{{"b", "c"}});
  EXPECT_TRUE(subscriptions.layers().hulls && subscriptions.layers().planes && !subscriptions.layers().search);
  EXPECT_EQ(subscriptions.series(), (std::vector<std::string>{"a", "b", "c"}));
  subscriptions.keep_only({2});
  EXPECT_FALSE(subscriptions.layers().hulls);
  EXPECT_EQ(subscriptions.series(), (std::vector<std::string>{"b", "c"}));
  std::vector<std::string> many;
  for (std::size_t k = 0; k < 10 * kMaxSeries; ++k) many.push_back(std::to_string(k));
  subscriptions.take(2, SeriesCommand{many});
  EXPECT_EQ(subscriptions.series().size(), kMaxSeries);
}

RC_GTEST_PROP(Commands, NeverThrowOnAnyBytes, (std::string text)) { (void)parse_command(text); }

RC_GTEST_PROP(JsonWriter, WritesWhatAParserReads, (const std::vector<double>& numbers)) {
  // Only valid UTF-8 reaches the bridge.
  const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(0, 0x7f));
  JsonWriter writer;
  writer.begin_object().key("numbers").begin_list();
  for (const double x : numbers) writer.number(x);
  writer.end_list().key("text").text(text).key("flag").flag(true).key("vec").vec3({0.0, -1.0, 1e6}).end_object();
  const std::string out = writer.take();
  const json read = json::parse(out);
  RC_ASSERT(read["numbers"].size() == numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (std::isfinite(numbers[k])) {
      RC_ASSERT(std::abs(read["numbers"][k].get<double>() - numbers[k]) <= 0.5e-4 + 1e-12 * std::abs(numbers[k]));
    } else {
      RC_ASSERT(read["numbers"][k].is_null());
    }
  }
  RC_ASSERT(read["text"].get<std::string>() == text);
}

}  // namespace
}  // namespace tern
