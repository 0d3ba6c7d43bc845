// Keys: how they are derived and read, and which process holds which.
#include "runtime/keys.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <vector>

#include "messages/channels.h"

namespace tern {
namespace {

Key counting_key() {
  std::array<std::uint8_t, kKeyBytes> bytes;
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return Key(bytes);
}

/// The numbers are those of Python: hashlib.blake2b(b"tern key 1 PLAN", key=bytes(range(32)), digest_size=32).
constexpr char kPlanKey[] = "66a0877742cefe6c8a2f43e538304dc6af403b5174aa42b2f1e5f27565e0c63e";

TEST(Keys, AreDerivedAsPythonDoes) { EXPECT_EQ(to_hex(derive_key(counting_key(), "tern key 1 PLAN")), kPlanKey); }

TEST(Keys, RandomOnesDiffer) { EXPECT_NE(to_hex(random_key()), to_hex(random_key())); }

TEST(KeyRing, GivesAProcessTheKeysOfWhatItSaysAndHearsAlone) {
  const KeyRing predictor = KeyRing::derive(counting_key(), "tern-predictor");
  EXPECT_EQ(predictor.role(), Role::Predictor);
  for (const char* channel :
       {channels::kPredictions.name, channels::kObstacleObservations.name, channels::kHeartbeat.name}) {
    EXPECT_NE(predictor.find(channel, predictor.role_on(channel)), nullptr) << channel;
  }
  for (const char* channel : {channels::kPlan.name, channels::kHorizonRequest.name, channels::kGoal.name,
                              channels::kSemanticMap.name, channels::kFlightResult.name}) {
    EXPECT_EQ(predictor.find(channel, predictor.role_on(channel)), nullptr) << channel;
  }
  EXPECT_NE(predictor.find(channels::kHeartbeat.name, Role::Vehicle), nullptr) << "clocks are compared by heartbeats";
  const KeyRing logger = KeyRing::derive(counting_key(), "tern-logger");
  EXPECT_EQ(logger.find(channels::kUavState.name, Role::Vehicle), nullptr) << "it records what it need not believe";
}

TEST(KeyRing, OnlyWhoHearsAPlanHoldsItsKey) {
  for (const ProcessRole& entry : process_roles()) {
    const KeyRing ring = KeyRing::derive(counting_key(), entry.process);
    const bool hears = entry.process == "tern-planner" || entry.process == "tern-executor" ||
                       entry.process == "tern-simulator" || entry.process == "tern-mavlink" ||
                       entry.process == "tern-monitor" || entry.process == "tern-viewer" ||
                       entry.process == "tern-ros2" || entry.process == "tern-dimos";
    EXPECT_EQ(ring.find(channels::kPlan.name, Role::Planner) != nullptr, hears) << entry.process;
  }
}

TEST(KeyRing, AnotherRolesChannelHasNoKeyForThisRole) {
  const KeyRing all = KeyRing::derive(counting_key(), "my-own-program");
  EXPECT_EQ(all.find(channels::kPlan.name, Role::Vehicle), nullptr);
  EXPECT_NE(all.find(channels::kPlan.name, Role::Planner), nullptr);
  EXPECT_NE(all.find("MY_OWN_CHANNEL", Role::Vehicle), nullptr);
}

TEST(KeyRing, ReadsWhatItSpellsAndTheMasterKeyInBothForms) {
  const Key master = counting_key();
  const KeyRing planner = KeyRing::derive(master, "tern-planner");
  const std::string raw(reinterpret_cast<const char*>(master.bytes().data()), kKeyBytes);
  for (const std::string& text :
       std::vector<std::string>{planner.to_text(), raw, to_hex(master), to_hex(master) + "\n"}) {
    const auto read = KeyRing::parse(text, "tern-planner");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->to_text(), planner.to_text());
  }
}

TEST(KeyRing, RefusesWhatIsNoneAndSaysNothingOfItsContents) {
  const std::string good = KeyRing::derive(counting_key(), "tern-planner").to_text();
  const std::string secret = kPlanKey;
  for (const std::string& text : std::vector<std::string>{
           std::string(), std::string(31, 'a'), std::string(33, 'a'), secret + "0", "x" + secret.substr(1),
           good.substr(0, good.size() - 2), good + "NOWHERE " + secret + "\n", good + "PLAN\n",
           "tern keys 1\nadmiral\n" + good.substr(20), "tern keys 2\nplanner\n"}) {
    const auto read = KeyRing::parse(text, "tern-planner");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().message.find(secret.substr(1, 16)), std::string::npos) << read.error().message;
  }
  const auto of_another = KeyRing::parse(good, "tern-predictor");
  ASSERT_FALSE(of_another);
  EXPECT_EQ(of_another.error().message, "holds the keys of the planner, not those of tern-predictor");
}

class KeyFiles : public testing::Test {
 protected:
  KeyFiles() {
    std::filesystem::create_directories(folder);
    std::ofstream(path) << kPlanKey << '\n';
    chmod(path.c_str(), 0600);
  }
  ~KeyFiles() override { std::filesystem::remove_all(folder); }
  [[nodiscard]] std::string refusal(const std::string& of) const {
    const auto read = read_key_file(of, "tern-planner");
    return read ? "" : read.error().message;
  }
  std::string folder = testing::TempDir() + "tern_keys_" + std::to_string(getpid());
  std::string path = folder + "/key";
};

TEST_F(KeyFiles, AreReadIfTheyAreTheirOwnersAlone) {
  EXPECT_EQ(refusal(path), "");
  for (const mode_t mode : {0640U, 0604U, 0620U, 0610U, 0666U}) {
    chmod(path.c_str(), mode);
    EXPECT_NE(refusal(path).find("readable by others than its owner; run chmod 600 " + path), std::string::npos)
        << mode;
  }
}

TEST_F(KeyFiles, ThatAreNoneAreRefusedByName) {
  EXPECT_EQ(refusal(folder + "/none"), folder + "/none: cannot be read: No such file or directory");
  EXPECT_EQ(refusal(folder), folder + ": a key is read from a regular file only");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: a key is read from a regular file only");
  mkfifo((folder + "/pipe").c_str(), 0600);
  EXPECT_EQ(refusal(folder + "/pipe"), folder + "/pipe: a key is read from a regular file only");
  std::ofstream(path) << "no key";
  EXPECT_EQ(refusal(path).rfind(path + ": holds no key", 0), 0U);
}

TEST_F(KeyFiles, AreReadFromADescriptorFromTheirBeginningAsOftenAsAProcessStarts) {
  const int held = open(path.c_str(), O_RDONLY);
  lseek(held, 20, SEEK_SET);
  for (int start = 0; start < 2; ++start) EXPECT_TRUE(read_key_fd(dup(held), "tern-planner"));
  EXPECT_TRUE(read_key_fd(held, "tern-planner"));
  EXPECT_EQ(fcntl(held, F_GETFD), -1) << "it is closed";
}

TEST(KeyRing, HeldInMemoryIsReadBackAndCannotBeChanged) {
  const KeyRing ring = KeyRing::derive(counting_key(), "tern-planner");
  const auto fd = seal_in_memory(ring);
  ASSERT_TRUE(fd);
  EXPECT_EQ(fcntl(*fd, F_GETFD), FD_CLOEXEC);
  EXPECT_EQ(write(*fd, "x", 1), -1);
  const auto read = read_key_fd(*fd, "tern-planner");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->to_text(), ring.to_text());
}

TEST_F(KeyFiles, APipeIsRefusedSinceItCanBeReadOnceOnly) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const auto read = read_key_fd(ends[0], "tern-planner");
  close(ends[1]);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("a pipe can be read once only"), std::string::npos);
}

}  // namespace
}  // namespace tern
