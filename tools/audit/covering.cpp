#include "tools/audit/covering.h"

#include "tools/audit/pairing.h"

namespace tern::audit {
namespace {

/// Appends the parts of `piece` outside `box`.
void cut_away(Box piece, const Box& box, std::vector<Box>& left) {
  if (!box.intersects(piece)) return left.push_back(piece);
  for (int axis = 0; axis < 3; ++axis) {
    if (piece.min()[axis] < box.min()[axis]) {
      left.push_back(piece);
      left.back().max()[axis] = piece.min()[axis] = box.min()[axis];
    }
    if (piece.max()[axis] > box.max()[axis]) {
      left.push_back(piece);
      left.back().min()[axis] = piece.max()[axis] = box.max()[axis];
    }
  }
}

/// The centre of a track at t, and the piece that t is in.
Vec3 centre_of(const Track& track, UTime t, std::size_t& piece) {
  if (track.kind == TrackKind::Static) return track.motion.pieces.front().coefficients.col(3);
  piece = track.motion.locate(t).index;
  return track.motion.sample(t).p;
}

}  // namespace

bool contain_together(const std::vector<Box>& boxes, const Box& whole) {
  std::vector<Box> left{whole}, next;
  for (const Box& box : boxes) {
    next.clear();
    for (const Box& piece : left) cut_away(piece, box, next);
    left.swap(next);
    if (left.empty()) return true;
  }
  return false;
}

bool intervals_contain(const TrackSet& set, UTime t, std::size_t level, const Box& whole, double tolerance) {
  std::vector<Box> boxes;
  for (const Track& track : set.tracks) {
    if (track.kind != TrackKind::Static && t > track.motion.end()) continue;
    std::size_t piece = 0;
    const Vec3 centre = centre_of(track, t, piece);
    const Box box = box_around(centre, track.half_extents + alpha_at(track, piece, level) + Vec3::Constant(tolerance));
    if (box.intersects(whole)) boxes.push_back(box);
  }
  return contain_together(boxes, whole);
}

}  // namespace tern::audit
