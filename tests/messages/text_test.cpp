#include <gtest/gtest.h>

#include <string>

#include "messages/fields.h"

namespace tern::wire {
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

}  // namespace
}  // namespace tern::wire
