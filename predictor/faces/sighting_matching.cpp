#include "predictor/faces/sighting_matching.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace tern {
namespace {

struct Pair {
  double cost;
  std::size_t track, sighting;
};

}  // namespace

std::vector<int> match_sightings(const std::vector<PredictedFaces>& tracks, const std::vector<Sighting>& sightings) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const auto& [box, anchor, gate] = tracks[t];
    const Box around = grown(box->completed(anchor), Vec3::Constant(gate));
    for (std::size_t s = 0; s < sightings.size(); ++s) {
      if (!around.intersects(Box(sightings[s].lower, sightings[s].upper))) continue;
      const double mismatch = box->mismatch(anchor, sightings[s], kNothingCompared * gate);
      if (mismatch < gate) pairs.push_back({mismatch + gate, t, s});
    }
  }
  std::ranges::sort(pairs, {}, [](const Pair& a) { return std::tuple(a.cost, a.track, a.sighting); });
  std::vector<int> sighting_of(tracks.size(), kNoSighting);
  std::vector<bool> is_taken(sightings.size(), false);
  for (const Pair& pair : pairs) {
    if (sighting_of[pair.track] != kNoSighting || is_taken[pair.sighting]) continue;
    sighting_of[pair.track] = static_cast<int>(pair.sighting);
    is_taken[pair.sighting] = true;
  }
  return sighting_of;
}

}  // namespace tern
