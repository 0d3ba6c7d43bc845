#include "geodesy/local_frame.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <utility>

namespace tern {

struct LocalFrame::Impl {
  GeographicLib::LocalCartesian cartesian;
};

LocalFrame::LocalFrame(const GeodeticPoint& origin, std::shared_ptr<const Impl> impl)
    : origin_(origin), impl_(std::move(impl)) {}

Result<LocalFrame> LocalFrame::at(const GeodeticPoint& origin) {
  if (const std::string why = why_not_on_earth(origin); !why.empty()) return fail(why);
  return LocalFrame(origin, std::make_shared<const Impl>(Impl{{origin.latitude, origin.longitude, origin.height}}));
}

Vec3 LocalFrame::to_world(const GeodeticPoint& place) const {
  Vec3 p;
  impl_->cartesian.Forward(place.latitude, place.longitude, place.height, p.x(), p.y(), p.z());
  return p;
}

GeodeticPoint LocalFrame::from_world(const Vec3& p) const {
  GeodeticPoint place;
  impl_->cartesian.Reverse(p.x(), p.y(), p.z(), place.latitude, place.longitude, place.height);
  return place;
}

}  // namespace tern
