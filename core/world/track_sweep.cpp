#include "core/world/track_sweep.h"

#include <algorithm>
#include <cmath>

namespace tern {
namespace {

/// The largest number of steps along a part of a piece. If β ≤ kBetaMax needs more, β is larger.
constexpr double kMaxSteps = 256.0;

/// Appends boxes along a piece between the local times a and b; the half-extents are enlarged by the sampling error β.
void add_piece(std::vector<CentredBox>& out, const PowerCubic& cubic, double a, double b, const Vec3& half) {
  const Vec3 acceleration = max_abs_acceleration(cubic, a, b);
  const double span = b - a;
  const double steps = std::ceil(span * std::sqrt(acceleration.maxCoeff() / (8.0 * kBetaMax)));
  const int n = static_cast<int>(std::clamp(steps, 1.0, kMaxSteps));
  const double h = span / n;
  const Vec3 grown_half = half + acceleration * (h * h / 8.0);
  for (int k = 0; k <= n; ++k) out.push_back({position_of(cubic, a + h * k), grown_half});
}

}  // namespace

void add_sweep(std::vector<CentredBox>& out, const Track& track, const AlphaShare& share, const Vec3& body_half,
               UTime origin, double from, double to) {
  const double start = (track.motion.start - origin).seconds();
  double piece_from = start;
  for (std::size_t k = 0; k < track.motion.pieces.size(); ++k) {
    const CubicPiece& piece = track.motion.pieces[k];
    const double piece_to = piece_from + piece.duration.seconds();
    const double a = std::max(from, piece_from);
    const double b = std::min(to, piece_to);
    if (a <= b) {
      const Vec3 half = track.half_extents + share.of(track, k) + body_half;
      add_piece(out, piece.coefficients, a - piece_from, b - piece_from, half);
    }
    piece_from = piece_to;
  }
  const auto add_growing = [&](double seconds, const Vec3& p, const Vec3& alpha) {
    out.push_back({p, track.half_extents + alpha + body_half + Vec3::Constant(track.top_speed * seconds)});
  };
  if (to > piece_from) {
    const CubicPiece& last = track.motion.pieces.back();
    add_growing(to - piece_from, position_of(last.coefficients, last.duration.seconds()),
                share.of(track, track.alpha.size() - 1));
  }
  if (from < start) add_growing(start - from, track.motion.pieces.front().coefficients.col(3), share.of(track, 0));
}

}  // namespace tern
