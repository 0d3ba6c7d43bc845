#include "perception/detector.h"

#include <algorithm>
#include <cstdint>

#include "perception/bounds.h"
#include "perception/clusters.h"
#include "perception/corner_fit.h"
#include "perception/slab_test.h"
#include "perception/view.h"

namespace tern {
namespace {

constexpr double kLeastPeeledShare = 0.08;
constexpr auto kNoFace = ClusterRays::kNoFace;

}  // namespace

struct Detector::Workspace {
  Clusters clusters;
  CornerFitter fitter;
  ClusterRays rays;
  SlabTest slabs;
  std::vector<std::uint8_t> is_known;
  std::vector<std::int8_t> fits;  ///< of the present cluster's pixels: 1, −1; of all others 0
  std::vector<int> pixels;
  std::vector<Sighting> sightings;

  void mark_boxes(const DepthPicture& picture, std::span<const Box> boxes);
  void mark_ground(const DepthPicture& picture, double ground_z);
  void take_group(const DepthPicture& picture, int g);
  void drop_lonely(const DepthPicture& picture);
  void peel(const DepthPicture& picture, int g);
};

/// A point is on a known box if it lies inside the box that is grown by the margin, give or take 3σ along its ray.
void Detector::Workspace::mark_boxes(const DepthPicture& picture, std::span<const Box> boxes) {
  if (boxes.empty()) return;
  slabs.prepare(picture);
  const DepthNoise& noise = picture.sensor().noise;
  for (const Box& box : boxes) {
    const Box margin = grown(box, Vec3::Constant(kSurroundingsMargin));
    slabs.visit(picture, margin, [&](int first, int count, const float* enter, const float* leave) {
      for (int k = 0; k < count; ++k) {
        const float depth = picture.depths()[first + k];
        const float slack = kFitSigmas * noise.sigma(depth);
        const bool inside = enter[k] <= leave[k] && depth >= enter[k] - slack && depth <= leave[k] + slack;
        if (inside) is_known[idx(first + k)] = 1;
      }
    });
  }
}

void Detector::Workspace::mark_ground(const DepthPicture& picture, double ground_z) {
  const auto height = static_cast<float>(ground_z + kSurroundingsMargin - picture.pose().position.z());
  const DepthNoise& noise = picture.sensor().noise;
  for (int pixel = 0; pixel < picture.shape().pixels(); ++pixel) {
    const float depth = picture.depths()[pixel], d_z = picture.rays_W()(pixel, 2);
    if (depth * d_z < height + kFitSigmas * noise.sigma(depth) * std::abs(d_z)) is_known[idx(pixel)] = 1;
  }
}

/// Gives each fitting ray to the others if most rays around it do not fit: noise puts it on a face that is not its own.
void Detector::Workspace::drop_lonely(const DepthPicture& picture) {
  const PictureShape& shape = picture.shape();
  for (std::size_t k = 0; k < rays.pixel.size(); ++k) fits[idx(rays.pixel[k])] = rays.face[k] == kNoFace ? -1 : 1;
  for (std::size_t k = 0; k < rays.pixel.size(); ++k) {
    const int v = rays.pixel[k] / shape.columns, u = rays.pixel[k] - v * shape.columns;
    int around = 0;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const int other = neighbour(shape, u + du, v + dv);
        if (other >= 0 && other != rays.pixel[k]) around += fits[idx(other)];
      }
    }
    if (around < 0) rays.face[k] = kNoFace;
  }
  for (const int pixel : rays.pixel) fits[idx(pixel)] = 0;
}

/// Splits off the rays that do not fit, if they are enough to be another object and leave one behind.
void Detector::Workspace::peel(const DepthPicture& picture, int g) {
  const int level = clusters.group(g).level;
  if (level >= kMostPeelings) return;
  drop_lonely(picture);
  pixels.clear();
  for (std::size_t k = 0; k < rays.depth.size(); ++k) {
    if (rays.face[k] == kNoFace) pixels.push_back(rays.pixel[k]);
  }
  const int misfits = static_cast<int>(pixels.size());
  const bool is_another = misfits >= std::max(kLeastPixels, static_cast<int>(kLeastPeeledShare * rays.count()));
  if (is_another && misfits <= rays.count() - kLeastPixels) clusters.split(picture, pixels, level + 1);
}

void Detector::Workspace::take_group(const DepthPicture& picture, int g) {
  if (clusters.group(g).count < kLeastPixels) return;
  rays.gather(picture, clusters.pixels(g));
  const Corner corner = fitter.fit(picture, rays);
  peel(picture, g);
  sightings.push_back(bounds_of(picture, clusters, g, rays, corner));
}

Detector::Detector() : work_(std::make_unique<Workspace>()) {}
Detector::~Detector() = default;
Detector::Detector(Detector&&) noexcept = default;
Detector& Detector::operator=(Detector&&) noexcept = default;

const std::vector<Sighting>& Detector::detect(const DepthPicture& picture, const KnownSurroundings& surroundings) {
  Workspace& work = *work_;
  work.is_known.assign(idx(picture.shape().pixels()), 0);
  work.fits.assign(idx(picture.shape().pixels()), 0);
  work.mark_boxes(picture, surroundings.boxes);
  if (surroundings.ground_z) work.mark_ground(picture, *surroundings.ground_z);
  work.pixels.clear();
  for (int pixel = 0; pixel < picture.shape().pixels(); ++pixel) {
    if (picture.is_surface(pixel) && work.is_known[idx(pixel)] == 0) work.pixels.push_back(pixel);
  }
  work.clusters.begin(picture);
  work.clusters.split(picture, work.pixels, 0);
  work.sightings.clear();
  for (int g = 0; g < work.clusters.count(); ++g) work.take_group(picture, g);
  return work.sightings;
}

SightingSet frame_of(const DepthPicture& picture, const std::vector<Sighting>& sightings, UTime at, int sensor_id) {
  SightingSet set;
  set.at = at;
  set.sensor_id = sensor_id;
  set.view = view_of(picture);
  set.sightings = sightings;
  const auto most = static_cast<std::size_t>(kMaxSightings);
  if (set.sightings.size() > most) {
    std::stable_sort(set.sightings.begin(), set.sightings.end(),
                     [](const Sighting& a, const Sighting& b) { return a.points > b.points; });
    set.left_out = static_cast<std::int32_t>(set.sightings.size() - most);
    set.sightings.resize(most);
  }
  return set;
}

}  // namespace tern
