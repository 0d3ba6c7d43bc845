#include "semantic_mapper/sources/class_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tern {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ClassNames, EveryNumberIsFoundByItsName) {
  for (int number = 0; number < 256; ++number) {
    const auto n = static_cast<std::uint8_t>(number);
    EXPECT_THAT(class_numbers(class_name(n)), ElementsAre(n)) << class_name(n);
    EXPECT_FALSE(is_class_group(class_name(n)));
  }
}

TEST(ClassNames, AreTheStandardOnes) {
  EXPECT_EQ(class_name(2), "ground");
  EXPECT_EQ(class_name(6), "building");
  EXPECT_EQ(class_name(9), "water");
  EXPECT_EQ(class_name(31), "class_31");
}

TEST(ClassNames, GroupsMeanTheirMembers) {
  EXPECT_THAT(class_numbers("vegetation"), ElementsAre(3, 4, 5));
  EXPECT_THAT(class_numbers("wire"), ElementsAre(13, 14, 16));
  EXPECT_TRUE(is_class_group("wire"));
}

TEST(ClassNames, OtherWordsMeanNothing) {
  for (const char* word : {"", "lava", "class_", "class_256", "class_-1", "class_3x", "Ground"}) {
    EXPECT_THAT(class_numbers(word), IsEmpty()) << word;
  }
}

}  // namespace
}  // namespace tern
