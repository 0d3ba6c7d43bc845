#include "core/base/digest.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace tern {
namespace {

TEST(Digest, IsFnv1a) {
  EXPECT_EQ(digest(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(digest("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(digest("foobar"), 0x85944171f73967e8ULL);
}

RC_GTEST_PROP(Digest, OfAWholeIsTheDigestOfItsPartsInTurn, (std::string head, std::string tail)) {
  RC_ASSERT(digest(head + tail) == digest(tail, digest(head)));
}

}  // namespace
}  // namespace tern
