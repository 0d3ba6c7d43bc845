#include "predictor/faces/size_record.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

bool is_similar(const KnownSizes& known, const Vec3& sizes) {
  for (int axis = 0; axis < 3; ++axis) {
    const double longer = sizes[axis] - known.sizes[axis];
    if (longer < -kSizeTolerance || (known.is_whole[idx(axis)] && longer > kSizeTolerance)) return false;
  }
  return true;
}

}  // namespace

void SizeRecord::add(std::int64_t track, const Vec3& sizes) {
  const auto own = std::ranges::find(entries_, track, &Entry::track);
  if (own != entries_.end()) {
    own->sizes = sizes;
    return;
  }
  if (entries_.size() == kMostSizes) entries_.erase(entries_.begin());
  entries_.push_back({track, sizes});
}

std::optional<double> SizeRecord::longest(int axis, const KnownSizes& known) const {
  int similar = 0;
  double longest = 0.0;
  for (const Entry& entry : entries_) {
    const Vec3 turned(entry.sizes.y(), entry.sizes.x(), entry.sizes.z());
    const bool is_like = is_similar(known, entry.sizes), is_like_turned = is_similar(known, turned);
    if (is_like) longest = std::max(longest, entry.sizes[axis]);
    if (is_like_turned) longest = std::max(longest, turned[axis]);
    similar += is_like || is_like_turned ? 1 : 0;
  }
  return similar >= kFewestSimilar ? std::optional(longest) : std::nullopt;
}

}  // namespace tern
