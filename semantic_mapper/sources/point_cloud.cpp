#include "semantic_mapper/sources/point_cloud.h"

#include <fmt/format.h>

#include "core/world/message_limits.h"

namespace tern {

std::optional<Vec3> PointFrame::to_world(const Vec3& p_file) const {
  const Vec3 p = (p_file - origin) * metres_per_unit;
  // NaN fails this comparison, so it is refused.
  if (!(p.cwiseAbs().array() <= kMaxCoordinate).all()) return std::nullopt;
  return p;
}

tl::unexpected<Error> bad_file(const std::string& file, std::size_t offset, const std::string& what) {
  return fail(fmt::format("{}, offset {}: {}", file, offset, what));
}

}  // namespace tern
