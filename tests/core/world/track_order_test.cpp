#include "core/world/track_order.h"

#include <gtest/gtest.h>

namespace tern {
namespace {

Track track_at(std::int64_t id, const Vec3& p, const Vec3& v) {
  Track track;
  track.id = id;
  track.half_extents = Vec3::Constant(0.5);
  CubicPiece piece{Duration{4'500'000}, PowerCubic::Zero()};
  piece.coefficients.col(2) = v;
  piece.coefficients.col(3) = p;
  track.motion.pieces = {piece};
  track.alpha = {Vec3::Zero()};
  return track;
}

std::vector<std::int64_t> ids(const std::vector<Track>& tracks) {
  std::vector<std::int64_t> all;
  for (const Track& track : tracks) all.push_back(track.id);
  return all;
}

TEST(SortByReach, PutsWhatCanReachTheVehicleFirstThenTheNearest) {
  std::vector<Track> tracks{
      track_at(1, Vec3(5, 0, 0), Vec3::Zero()),     // near, never comes
      track_at(2, Vec3(20, 0, 0), Vec3(-5, 0, 0)),  // far, arrives after 4 s
      track_at(3, Vec3(10, 0, 0), Vec3(-3, 0, 0)),  // nearer, arrives after 3.3 s
      track_at(4, Vec3(50, 0, 0), Vec3::Zero()),   track_at(5, Vec3(30, 0, 0), Vec3(-5, 0, 0)),  // comes to 7.5 m
  };
  sort_by_reach(tracks, Vec3::Zero(), UTime{}, Duration{4'500'000});
  EXPECT_EQ(ids(tracks), (std::vector<std::int64_t>{3, 2, 1, 5, 4}));
}

TEST(SortByReach, BreaksTiesById) {
  std::vector<Track> tracks{track_at(9, Vec3(5, 0, 0), Vec3::Zero()), track_at(2, Vec3(-5, 0, 0), Vec3::Zero())};
  sort_by_reach(tracks, Vec3::Zero(), UTime{}, Duration{4'500'000});
  EXPECT_EQ(ids(tracks), (std::vector<std::int64_t>{2, 9}));
}

}  // namespace
}  // namespace tern
