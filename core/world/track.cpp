#include "core/world/track.h"

#include "core/world/alpha_count.h"

namespace tern {

Box Track::bounds(UTime t0, UTime t1) const { return counted_bounds(*this, t0, t1, {}); }

Box counted_bounds(const Track& track, UTime t0, UTime t1, const AlphaCount& count) {
  const PiecewiseCubic& motion = track.motion;
  const auto half = [&](std::size_t piece) -> Vec3 { return track.half_extents + count.of(track, piece); };
  Box box;
  UTime piece_start = motion.start;
  const UTime end = motion.end();
  for (std::size_t k = 0; k < motion.pieces.size(); ++k) {
    const CubicPiece& piece = motion.pieces[k];
    const UTime piece_end = piece_start + piece.duration;
    const UTime from = std::max(piece_start, t0);
    const UTime to = std::min(piece_end, t1);
    if (from <= to) {
      const Box swept = cubic_bounds(piece.coefficients, (from - piece_start).seconds(), (to - piece_start).seconds());
      box.extend(grown(swept, half(k)));
    }
    piece_start = piece_end;
  }
  if (track.kind == TrackKind::Static) {
    const Vec3 p = motion.pieces.front().coefficients.col(3);
    return box_around(p, half(0));
  }
  if (t1 > end) {
    const Vec3 p = motion.sample(end).p;
    box.extend(box_around(p, half(track.alpha.size() - 1) + Vec3::Constant(track.top_speed * (t1 - end).seconds())));
  }
  if (t0 < motion.start) {
    const Vec3 p = motion.sample(motion.start).p;
    const double back_s = (motion.start - t0).seconds();
    box.extend(box_around(p, half(0) + Vec3::Constant(track.top_speed * back_s)));
  }
  return box;
}

}  // namespace tern
