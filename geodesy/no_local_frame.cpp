// In place of local_frame.cpp where GeographicLib is not installed: no frame can be made.
#include <stdexcept>
#include <utility>

#include "geodesy/local_frame.h"

namespace tern {

struct LocalFrame::Impl {};

LocalFrame::LocalFrame(const GeodeticPoint& origin, std::shared_ptr<const Impl> impl)
    : origin_(origin), impl_(std::move(impl)) {}

Result<LocalFrame> LocalFrame::at(const GeodeticPoint& origin) {
  if (const std::string why = why_not_on_earth(origin); !why.empty()) return fail(why);
  return fail(
      "Tern was built without GeographicLib, which converts latitude and longitude: install libgeographiclib-dev and "
      "build again");
}

Vec3 LocalFrame::to_world(const GeodeticPoint& /*place*/) const { throw std::logic_error("LocalFrame: none"); }
GeodeticPoint LocalFrame::from_world(const Vec3& /*p*/) const { throw std::logic_error("LocalFrame: none"); }

}  // namespace tern
