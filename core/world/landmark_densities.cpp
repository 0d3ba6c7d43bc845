#include "core/world/landmark_densities.h"

#include "core/base/digest.h"

namespace tern {

std::uint64_t name_of(const LandmarkDensities& densities) {
  const auto with = [](std::uint64_t seed, const auto* numbers, std::size_t count) {
    return digest({reinterpret_cast<const char*>(numbers), count * sizeof(*numbers)}, seed);
  };
  const SurfaceDensities& d = densities.densities;
  const std::uint64_t of_tracks = with(kDigestSeed, &densities.tracks, 1);
  const std::uint64_t of_map = with(of_tracks, &densities.map_version, 1);
  return with(with(of_map, &d.obstacles, 1), d.by_class.data(), d.by_class.size());
}

}  // namespace tern
