// The frame W on the earth.
#include "geodesy/local_frame.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

namespace tern {
namespace {

/// ECEF coordinates by the textbook formula, the oracle.
Vec3 geocentric(const GeodeticPoint& place) {
  constexpr double kA = 6'378'137.0, kF = 1.0 / 298.257223563, kDegree = std::numbers::pi / 180.0;
  constexpr double kE2 = kF * (2.0 - kF);
  const double lat = place.latitude * kDegree, lon = place.longitude * kDegree;
  const double n = kA / std::sqrt(1.0 - kE2 * std::sin(lat) * std::sin(lat));
  return {(n + place.height) * std::cos(lat) * std::cos(lon), (n + place.height) * std::cos(lat) * std::sin(lon),
          (n * (1.0 - kE2) + place.height) * std::sin(lat)};
}

Vec3 oracle(const GeodeticPoint& origin, const GeodeticPoint& place) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double lat = origin.latitude * kDegree, lon = origin.longitude * kDegree;
  Eigen::Matrix3d to_enu;
  to_enu << -std::sin(lon), std::cos(lon), 0.0,                                       //
      -std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat),  //
      std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat);
  return to_enu * (geocentric(place) - geocentric(origin));
}

RC_GTEST_PROP(LocalFrame, IsEastNorthUpOfTheEllipsoid, ()) {
  const auto within = [](double limit) {
    return static_cast<double>(*rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'001)) * 1e-6 * limit;
  };
  const GeodeticPoint origin{within(85.0), within(180.0), within(3000.0)};
  const GeodeticPoint place{origin.latitude + within(0.05), origin.longitude + within(0.05),
                            origin.height + within(500.0)};
  const LocalFrame frame = LocalFrame::at(origin).value();
  const Vec3 p = frame.to_world(place);
  RC_ASSERT((p - oracle(origin, place)).norm() < 1e-6);
  const GeodeticPoint back = frame.from_world(p);
  RC_ASSERT(std::abs(back.latitude - place.latitude) < 1e-11);
  RC_ASSERT(std::abs(back.height - place.height) < 1e-6);
}

/// CartConvert is GeographicLib's own program.
TEST(LocalFrame, AgreesWithCartConvertWithinACentimetreAtFiveKilometres) {
  const GeodeticPoint origin{47.3977, 8.5456, 488.0};
  const LocalFrame frame = LocalFrame::at(origin).value();
  std::string command = "printf '";
  std::vector<Vec3> ours;
  for (int k = 0; k < 36; ++k) {
    const double angle = k * std::numbers::pi / 18.0;
    const GeodeticPoint place{origin.latitude + 5000.0 / 111'178.0 * std::sin(angle),
                              origin.longitude + 5000.0 / 75'400.0 * std::cos(angle), 488.0 + 10.0 * k};
    ours.push_back(frame.to_world(place));
    command += fmt::format("{:.12f} {:.12f} {:.6f}\\n", place.latitude, place.longitude, place.height);
  }
  command += fmt::format("' | CartConvert -p 6 -l {} {} {}", origin.latitude, origin.longitude, origin.height);
  FILE* const pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  for (const Vec3& p : ours) {
    Vec3 theirs;
    ASSERT_EQ(std::fscanf(pipe, "%lf %lf %lf", &theirs.x(), &theirs.y(), &theirs.z()), 3)
        << "CartConvert is of the package geographiclib-tools";
    EXPECT_NEAR(p.head<2>().norm(), 5000.0, 30.0);
    EXPECT_LT((p - theirs).norm(), 0.01);
  }
  EXPECT_EQ(pclose(pipe), 0);
}

TEST(LocalFrame, CurvesAwayWithTheEarth) {
  const LocalFrame frame = LocalFrame::at({47.3977, 8.5456, 488.0}).value();
  const Vec3 p = frame.to_world({47.3977 + 5000.0 / 111'178.0, 8.5456, 488.0});
  EXPECT_NEAR(p.y(), 5000.0, 5.0);
  EXPECT_NEAR(p.z(), -1.96, 0.01);
}

TEST(LocalFrame, RefusesPlacesThatAreNoneOnTheEarth) {
  EXPECT_EQ(LocalFrame::at({91.0, 0.0, 0.0}).error().message, "latitude 91 is out of range [-90, 90]");
  EXPECT_EQ(LocalFrame::at({0.0, 181.0, 0.0}).error().message, "longitude 181 is out of range [-180, 180]");
  EXPECT_FALSE(LocalFrame::at({std::nan(""), 0.0, 0.0}).has_value());
}

}  // namespace
}  // namespace tern
