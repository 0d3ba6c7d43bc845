#include "core/base/plain_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/random.h"

namespace tern {
namespace {

TEST(PlainText, IsUtf8WithoutControlCharacters) {
  for (const std::string text :
       {"", "tern-planner", "a\tb\nc", "α ≤ 3", "木", "\xF0\x9F\x9C\x81", "\xEF\xBF\xBF", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(is_plain_text(text)) << text;
  }
}

TEST(PlainText, IsNoControlCharacter) {
  for (const std::string& text :
       {std::string(1, '\0'), std::string("\x1b[2J"), std::string("\r"), std::string("\x7f")}) {
    EXPECT_FALSE(is_plain_text(text));
  }
}

TEST(PlainText, IsNoBrokenOverlongOrSurrogateSequence) {
  for (const char* text : {"\x80", "\xC3", "\xC3(", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF0\x80\x80\xAF",
                           "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "ab\xE2\x82"}) {
    EXPECT_FALSE(is_plain_text(text));
  }
}

TEST(PlainText, IsReturnedAsItIs) {
  for (const std::string text : {"", "tern-planner", "a\tb\nc", "α ≤ 3", "木", "\xF0\x9F\x9C\x81"}) {
    EXPECT_EQ(plain_text(text), text);
    EXPECT_EQ(plain_text(text, text.size()), text);
  }
}

TEST(PlainText, HasAQuestionMarkForEachByteOfNoPlainCharacter) {
  EXPECT_EQ(plain_text("id \xff\x01."), "id ??.");
  EXPECT_EQ(plain_text(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(plain_text("\x1b[2J\r\x7f"), "?[2J??");
  EXPECT_EQ(plain_text("σ\xE2\x82"), "σ??") << "a character without its end";
  EXPECT_EQ(plain_text("\xC3σ"), "?σ") << "the next character is whole";
}

TEST(PlainText, IsCutBetweenCharacters) {
  EXPECT_EQ(plain_text("aσσ", 5), "aσσ");
  EXPECT_EQ(plain_text("aσσ", 4), "aσ");
  EXPECT_EQ(plain_text("aσσ", 1), "a");
  EXPECT_EQ(plain_text("σ", 1), "");
  EXPECT_EQ(plain_text("a", 0), "");
}

TEST(PlainText, OfAnyBytesIsPlainAndNoLonger) {
  Rng rng(1);
  for (int n = 0; n < 20'000; ++n) {
    std::string bytes(static_cast<std::size_t>(rng.uniform(0, 20)), '\0');
    for (char& c : bytes) c = static_cast<char>(static_cast<int>(rng.uniform(0, 256)));
    const auto most = static_cast<std::size_t>(rng.uniform(0, 25));
    const std::string text = plain_text(bytes, most);
    ASSERT_TRUE(is_plain_text(text));
    ASSERT_LE(text.size(), std::min(most, bytes.size()));
    ASSERT_EQ(plain_text(bytes) == bytes, is_plain_text(bytes));
  }
}

}  // namespace
}  // namespace tern
