// Programs that stand for tern-unlaz: what tern-mapper makes of each end that a child can have.
#include "semantic_mapper/app/laz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "semantic_mapper/sources/las.h"
#include "tests/support/cloud_files.h"
#include "tests/support/temp_folder.h"

namespace tern {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// A temporary folder with a shell script as tern-unlaz.
class LazTest : public ::testing::Test {
 protected:
  [[nodiscard]] Result<std::vector<std::uint8_t>> run(const std::string& script,
                                                      std::size_t max_bytes = 100'000) const {
    const std::string program = folder_.file("tern-unlaz");
    std::ofstream(program) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    return decompress_laz("town.laz", program, max_bytes);
  }
  [[nodiscard]] std::string error_of(const std::string& script) const {
    const auto bytes = run(script);
    return bytes ? "" : bytes.error().message;
  }

  TempFolder folder_;
};

std::string text(const Result<std::vector<std::uint8_t>>& bytes) {
  return bytes ? std::string(bytes->begin(), bytes->end()) : bytes.error().message;
}

TEST_F(LazTest, TakesTheOutputOfAProgramThatEndsWell) {
  EXPECT_EQ(text(run("printf LASF; echo a warning >&2")), "LASF");
  EXPECT_EQ(text(run("printf %s \"$1\"")), std::filesystem::absolute("town.laz").string());
  EXPECT_EQ(text(run("true")), "");
}

TEST_F(LazTest, TakesOutputAndErrorsThatAreLongerThanAPipe) {
  const auto bytes = run("head -c 90000 /dev/zero >&2; head -c 100000 /dev/zero; head -c 90000 /dev/zero >&2");
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(bytes->size(), 100'000u);
}

TEST_F(LazTest, QuotesTheLastLineOfAProgramThatFails) {
  EXPECT_EQ(error_of("echo a warning >&2; echo 'tern-unlaz: chunk 3 is damaged' >&2; exit 2"),
            "town.laz: tern-unlaz: chunk 3 is damaged");
  EXPECT_EQ(error_of("printf LASF; exit 2"), "town.laz: tern-unlaz ended with exit code 2");
  EXPECT_EQ(error_of("printf 'bad \\033[31m' >&2; exit 2"), "town.laz: bad ?[31m");
  EXPECT_EQ(error_of("head -c 90000 /dev/zero | tr '\\0' x >&2; exit 2").size(),
            std::string("town.laz: ").size() + 200);
}

TEST_F(LazTest, ReportsASignal) {
  EXPECT_EQ(error_of("printf LASF; kill -SEGV $$"),
            "town.laz: tern-unlaz crashed (signal 11): the file is damaged, or LASzip has a defect");
  EXPECT_EQ(error_of("kill -XCPU $$"), "town.laz: tern-unlaz needed more than 600 s of CPU time");
}

TEST_F(LazTest, EndsAProgramWhoseOutputIsEndless) {
  EXPECT_EQ(error_of("cat /dev/zero"), "town.laz: more than 100000 bytes when decompressed (limit)");
}

TEST_F(LazTest, LimitsTimeAndMemory) {
  EXPECT_EQ(text(run("ulimit -t; ulimit -v")), "600\n1953125\n");  // the latter in units of 1024 bytes
}

TEST_F(LazTest, SaysWhatToDoWithoutTheProgram) {
  const auto bytes = decompress_laz("town.laz", folder_.file("no-program"), 1000);
  ASSERT_FALSE(bytes);
  EXPECT_THAT(bytes.error().message, HasSubstr("town.laz: compressed (LAZ) points, and Tern was built without LASzip"));
  EXPECT_THAT(bytes.error().message, HasSubstr("no-program"));
  EXPECT_THAT(bytes.error().message, EndsWith("decompress the file first, as by `pdal translate FILE.laz FILE.las`"));
}

TEST(Laz, TheProgramIsBesideTheRunningOne) {
  EXPECT_EQ(unlaz_program(), (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "tern-unlaz").string());
}

TEST(Laz, IsKnownByItsContent) {
  support::FileBytes bytes = support::las_file({{Vec3::Zero(), 2}}, {});
  EXPECT_FALSE(is_compressed_las(bytes));
  bytes[104] |= 128U;
  EXPECT_TRUE(is_compressed_las(bytes));
  EXPECT_FALSE(is_compressed_las(std::span(bytes).first(104)));
  EXPECT_FALSE(is_compressed_las({}));
  bytes[0] = 'l';
  EXPECT_FALSE(is_compressed_las(bytes));
}

}  // namespace
}  // namespace tern
