// Bad pairs of images are named; good ones pass.
#include "features/image_check.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"
#include "core/base/types.h"

namespace tern {
namespace {

GrayImage noise(std::uint64_t seed, int width = 64, int height = 48) {
  Rng random(seed);
  GrayImage image{width, height, std::vector<std::uint8_t>(idx(width * height))};
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(random.uniform(0.0, 256.0));
  return image;
}

GrayImage uniform(std::uint8_t grey) { return {64, 48, std::vector<std::uint8_t>(64 * 48, grey)}; }

TEST(ImageCheck, NamesEachTrouble) {
  ImageCheck check({64, 48}, {64, 48});
  EXPECT_EQ(check.check(UTime{10}, noise(1), noise(2)), std::nullopt);
  EXPECT_EQ(check.check(UTime{20}, noise(3), noise(4, 48, 64)), ImageTrouble::WrongSize);
  EXPECT_EQ(check.check(UTime{20}, {}, {}), ImageTrouble::WrongSize);
  EXPECT_EQ(check.check(UTime{10}, noise(3), noise(4)), ImageTrouble::TimeBack);
  EXPECT_EQ(check.check(UTime{20}, noise(1), noise(2)), ImageTrouble::Repeated);
  EXPECT_EQ(check.check(UTime{30}, noise(1), noise(5)), std::nullopt) << "one stuck image may be a bare wall";
  EXPECT_EQ(check.check(UTime{40}, noise(6), uniform(3)), ImageTrouble::Dark);
  EXPECT_EQ(check.check(UTime{50}, uniform(3), uniform(3)), ImageTrouble::Dark) << "black images repeat";
  EXPECT_EQ(check.check(UTime{60}, uniform(255), noise(7)), ImageTrouble::Saturated);
  EXPECT_EQ(check.check(UTime{70}, noise(8), noise(9)), std::nullopt);
}

TEST(ImageCheck, ADarkSceneWithALampIsUsed) {
  GrayImage lamp = uniform(3);
  for (int k = 0; k < 64; ++k) lamp.pixels[idx(k)] = 200;
  ImageCheck check({64, 48}, {64, 48});
  EXPECT_EQ(check.check(UTime{1}, lamp, lamp), std::nullopt);
}

TEST(ImageCheck, EveryTroubleHasItsText) {
  std::set<std::string> texts;
  for (int k = 0; k < 5; ++k) texts.insert(to_text(static_cast<ImageTrouble>(k)));
  EXPECT_EQ(texts.size(), 5u);
  EXPECT_FALSE(texts.contains("unknown"));
}

}  // namespace
}  // namespace tern
