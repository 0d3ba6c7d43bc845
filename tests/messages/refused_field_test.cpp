#include "messages/refused_field.h"

#include <gtest/gtest.h>

#include <limits>

#include "messages/codec.h"

namespace tern {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ObservationSet two_detections() {
  ObservationSet set;
  set.header = {{1, 1}, UTime{1}};
  set.detections.resize(2);
  return set;
}

template <class T>
std::string refused(const T& message) {
  return refused_field<T>(encode(message));
}

TEST(RefusedField, NamesAFieldOfAnElementAndItsValue) {
  ObservationSet set = two_detections();
  EXPECT_EQ(refused(set), "");
  set.detections[1].variance.y() = -1.0;
  EXPECT_EQ(refused(set), "detections[1].variance.y is -1");
  set.detections[0].half_extents.x() = kNaN;
  EXPECT_EQ(refused(set), "detections[0].half_extents.x is nan") << "the first one";
}

TEST(RefusedField, NamesTheFirstElementThatIsLeftOut) {
  ObservationSet set = two_detections();
  set.detections.resize(4);
  set.detections[1].position.z() = kNaN;
  set.detections[2].position.x() = kNaN;
  EXPECT_EQ(refused(set), "detections[1].position.z is nan");
  EXPECT_EQ(left_out_elements<ObservationSet>(encode(set)), 2);
  set.detections[3].half_extents.x() = -1.0;
  EXPECT_EQ(refused(set), "detections[3].half_extents.x is -1") << "for this one the set is refused";
  EXPECT_EQ(left_out_elements<ObservationSet>(encode(set)), 0);
}

TEST(RefusedField, NamesFieldsOutsideOfLists) {
  ObservationSet set = two_detections();
  set.sensor_id = -4;
  EXPECT_EQ(refused(set), "sensor_id is -4");
  set = two_detections();
  set.header.name.sequence = 0;
  EXPECT_EQ(refused(set), "header.name.sequence is 0");
  UavState state;
  state.header = {{1, 1}, UTime{1}};
  state.motion.v.z() = kNaN;
  EXPECT_EQ(refused(state), "motion.velocity.z is nan");
}

TEST(RefusedField, NamesTheTrackOfAPiece) {
  TrackSet set;
  set.header = {{1, 1}, UTime{1}};
  set.batch = {1, 0, 1};
  for (std::int64_t id = 0; id < 2; ++id) {
    Track track;
    track.id = id;
    track.kind = TrackKind::Declared;
    track.motion.pieces.push_back({Duration{1'000'000}, PowerCubic::Zero()});
    track.alpha.push_back(Vec3::Zero());
    set.tracks.push_back(track);
  }
  EXPECT_EQ(refused(set), "");
  set.tracks[1].alpha[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refused(set), "tracks[1].alpha.x is inf");
}

TEST(RefusedField, NamesABrokenRule) {
  ObservationSet set = two_detections();
  for (Detection& detection : set.detections) detection.track_id = 7;
  EXPECT_EQ(refused(set), "two detections have the track_id 7");
}

TEST(RefusedField, IsEmptyForBytesOfAnotherForm) {
  Bytes bytes = encode(two_detections());
  bytes.pop_back();
  EXPECT_EQ(refused_field<ObservationSet>(bytes), "");
}

}  // namespace
}  // namespace tern
