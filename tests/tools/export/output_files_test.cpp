// An export harms no file: neither the log that it reads nor what an earlier export wrote.
#include "tools/export/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "tests/support/recorded_flight.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/export/mcap_file.h"
#include "tools/export/export_log.h"

namespace tern::exporting {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A folder with the log of the first second of a flight.
class ExportedFiles : public ::testing::Test {
 protected:
  static constexpr std::int64_t kUntilUs = 2'000'000;  // virtual time begins at 1 s

  void SetUp() override {
    tern::testing::copy_part_of_log(tern::testing::recorded_log("crowded"), log_, 0, kUntilUs);
    ASSERT_GT(fs::file_size(log_), 0U);
  }
  static Result<std::string> to_mcap(const std::string& log, const std::string& file) {
    return export_log({.log = log, .csv_folder = "", .mcap_file = file, .bag_folder = "", .suffix = ""});
  }
  static Result<std::string> to_csv(const std::string& log, const std::string& tables) {
    return export_log({.log = log, .csv_folder = tables, .mcap_file = "", .bag_folder = "", .suffix = ""});
  }
  static Result<std::string> to_bag(const std::string& log, const std::string& bag) {
    return export_log({.log = log, .csv_folder = "", .mcap_file = "", .bag_folder = bag, .suffix = ""});
  }
  static std::string error_of(const Result<std::string>& told) { return told ? "" : told.error().message; }
  static std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
  [[nodiscard]] std::string folder() const { return fs::path(log_).parent_path().string(); }

  TempFolder folder_;
  std::string log_ = folder_.file("flight.lcm");
};

TEST_F(ExportedFiles, NeverReplaceTheLogUnderWhateverNameItIsGiven) {
  const std::string before = read_text(log_);
  const std::string link = folder_.file("link.mcap"), second_name = folder_.file("second.mcap");
  fs::create_symlink(log_, link);
  fs::create_hard_link(log_, second_name);
  for (const std::string& name : {log_, link, second_name, folder() + "/./flight.lcm"}) {
    EXPECT_THAT(error_of(to_mcap(log_, name)), HasSubstr("the log itself would be overwritten"));
    EXPECT_EQ(read_text(log_), before) << name;
  }
  EXPECT_THAT(error_of(to_mcap(folder(), log_)), HasSubstr("the log itself would be overwritten")) << "by its folder";
  EXPECT_EQ(read_text(log_), before);
  EXPECT_THAT(names_in(folder()), ElementsAre("flight.lcm", "link.mcap", "second.mcap"));
}

TEST_F(ExportedFiles, NeverReplaceALogThatIsNamedAsATableOrAsAPart) {
  const std::string before = read_text(log_);
  for (const char* name : {"HEARTBEAT.csv", "HEARTBEAT.csv.part"}) {
    const TempFolder tables;
    const std::string own = tables.file(name);
    fs::copy_file(log_, own);
    EXPECT_THAT(error_of(to_csv(own, fs::path(own).parent_path().string())), HasSubstr("the log itself"));
    EXPECT_EQ(read_text(own), before);
    EXPECT_THAT(names_in(fs::path(own).parent_path().string()), ElementsAre(name)) << "no other table is left";
  }
  const std::string part = folder_.file("a.mcap.part");
  fs::copy_file(log_, part);
  EXPECT_THAT(error_of(to_mcap(part, folder_.file("a.mcap"))), HasSubstr("the log itself"));
  EXPECT_EQ(read_text(part), before);
}

TEST_F(ExportedFiles, OfBeforeStayIfTheLogCannotBeReadOrHoldsNothing) {
  const std::string good = folder_.file("good.mcap"), bag = folder_.file("bag"), empty = folder_.file("empty.lcm");
  fs::create_directories(bag);
  ASSERT_TRUE(write_text(good, "old"));
  ASSERT_TRUE(write_text(bag + "/bag_0.mcap", "old"));
  ASSERT_TRUE(write_text(empty, ""));
  for (const std::string& log : {folder_.file("typo"), empty}) {
    EXPECT_FALSE(to_mcap(log, good));
    EXPECT_FALSE(to_bag(log, bag));
    EXPECT_EQ(read_text(good), "old");
    EXPECT_EQ(read_text(bag + "/bag_0.mcap"), "old");
  }
  EXPECT_THAT(names_in(folder()), ElementsAre("bag", "empty.lcm", "flight.lcm", "good.mcap"));
  EXPECT_THAT(names_in(bag), ElementsAre("bag_0.mcap"));
}

TEST_F(ExportedFiles, OfAnEarlierExportAreReplacedByWholeOnes) {
  const std::string mcap = folder_.file("a.mcap"), bag = folder_.file("bag"), tables = folder_.file("tables");
  fs::create_directories(tables);
  ASSERT_TRUE(write_text(mcap, "old"));
  ASSERT_TRUE(write_text(tables + "/HEARTBEAT.csv", "old"));
  EXPECT_EQ(error_of(to_mcap(log_, mcap)), "");
  EXPECT_EQ(error_of(to_bag(log_, bag)), "");
  EXPECT_EQ(error_of(to_csv(log_, tables)), "");
  EXPECT_FALSE(tern::testing::read_mcap(mcap).messages.empty());
  EXPECT_THAT(read_text(tables + "/HEARTBEAT.csv"), HasSubstr("message,received_us"));
  EXPECT_THAT(names_in(folder()), ElementsAre("a.mcap", "bag", "flight.lcm", "tables"));
  EXPECT_THAT(names_in(bag), ElementsAre("bag_0.mcap", "metadata.yaml"));
  for (const std::string& name : names_in(tables)) EXPECT_EQ(fs::path(name).extension().string(), ".csv") << name;
}

TEST_F(ExportedFiles, FollowALinkAndLeaveADeviceWhereItIs) {
  const std::string real = folder_.file("real.mcap"), link = folder_.file("link.mcap");
  ASSERT_TRUE(write_text(real, "old"));
  fs::create_symlink(real, link);
  EXPECT_EQ(error_of(to_mcap(log_, link)), "");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_FALSE(tern::testing::read_mcap(real).messages.empty());
  EXPECT_EQ(OutputFiles({log_}).part_of("/dev/null").string(), "/dev/null");
}

}  // namespace
}  // namespace tern::exporting
