#include "semantic_mapper/sources/point_cloud.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/plain_text.h"
#include "core/wire/message_limits.h"

namespace tern {

void CloudFile::add(const Vec3& p_file, const PointFrame& frame, double label) {
  if (!p_file.allFinite()) {
    ++not_finite;
    return;
  }
  const auto p = frame.to_world(p_file);
  if (!p) {
    if (too_far++ == 0) first_too_far = p_file;
  } else if (!(label >= 0.0 && label <= 255.0) || label != std::floor(label)) {
    ++not_a_class;
  } else {
    points.push_back({*p, static_cast<std::uint8_t>(label)});
  }
}

std::optional<Vec3> PointFrame::to_world(const Vec3& p_file) const {
  const Vec3 p = (p_file - origin) * metres_per_unit;
  // NaN fails this comparison, so it is refused.
  if (!(p.cwiseAbs().array() <= kMaxCoordinate).all()) return std::nullopt;
  return p;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 200;
  std::string text;
  for (const std::string& name : names) {
    if (text.size() + name.size() > kShown) return text + " …";
    text += (text.empty() ? "" : ", ") + plain_text(name);
  }
  return text;
}

tl::unexpected<Error> bad_file(const std::string& file, std::size_t offset, const std::string& what) {
  return fail(plain_text(fmt::format("{}, offset {}: {}", file, offset, what)));
}

}  // namespace tern
