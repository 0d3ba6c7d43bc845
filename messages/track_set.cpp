#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/track_set_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::track_set_t;
static_assert(Message::MAX_TRACKS == kMaxTracksPerBatch);
static_assert(Message::MAX_PIECES == kMaxPiecesPerBatch);

const wire::Layout kLayout{
    wire::Array{&Message::track_count, &Message::tracks, 0, kMaxTracksPerBatch},
    wire::Array{&Message::piece_count, &Message::pieces, 0, kMaxPiecesPerBatch},
    wire::Array{&Message::share_count, &Message::shares, 0, kMaxPiecesPerBatch},
};

tern_msgs::track_t to_lcm(const Track& track) {
  tern_msgs::track_t m{};
  m.id = track.id;
  m.kind = wire::to_int8(track.kind);
  m.half_extents = wire::to_lcm(track.half_extents);
  m.start_us = track.motion.start.us;
  m.piece_count = static_cast<std::int32_t>(track.motion.pieces.size());
  m.top_speed = track.top_speed;
  return m;
}

tern_msgs::track_piece_t to_lcm(const CubicPiece& piece, const Vec3& alpha) {
  tern_msgs::track_piece_t m{};
  m.duration_us = piece.duration.us;
  m.c3 = wire::to_lcm(Vec3(piece.coefficients.col(0)));
  m.c2 = wire::to_lcm(Vec3(piece.coefficients.col(1)));
  m.c1 = wire::to_lcm(Vec3(piece.coefficients.col(2)));
  m.c0 = wire::to_lcm(Vec3(piece.coefficients.col(3)));
  m.alpha = wire::to_lcm(alpha);
  return m;
}

tern_msgs::alpha_shares_t to_lcm(const AlphaShares& shares) {
  tern_msgs::alpha_shares_t m{};
  std::copy(shares.begin(), shares.end(), m.at);
  return m;
}

/// @throws std::invalid_argument where the numbers of a track's pieces, α and shares do not go together
void require_complete(const Track& track) {
  const std::size_t pieces = track.motion.pieces.size();
  const std::string name = "track " + std::to_string(track.id);
  if (track.alpha.size() != pieces) throw std::invalid_argument(name + ": as many alphas as pieces are needed");
  if (track.shares.size() != (track.kind == TrackKind::Estimated ? pieces : 0)) {
    throw std::invalid_argument(name + ": as many shares as pieces are needed of what is estimated, none of others");
  }
}

Message to_lcm(const TrackSet& set) {
  Message m{};
  m.header = wire::to_lcm(set.header);
  m.batch = wire::to_lcm(set.batch);
  m.made_at_us = set.made_at.us;
  m.confidence = set.confidence;
  m.left_out = set.left_out;
  for (const Track& track : set.tracks) {
    require_complete(track);
    m.tracks.push_back(to_lcm(track));
    for (std::size_t k = 0; k < track.alpha.size(); ++k)
      m.pieces.push_back(to_lcm(track.motion.pieces[k], track.alpha[k]));
    for (const AlphaShares& shares : track.shares) m.shares.push_back(to_lcm(shares));
  }
  return m;
}

CubicPiece read_piece(wire::FieldReader& read, const tern_msgs::track_piece_t& m) {
  CubicPiece piece;
  piece.duration = read.duration(m.duration_us, Duration{1}, kMaxSpan);
  piece.coefficients.col(0) = read.vec3(m.c3, -kMaxJerk, kMaxJerk);
  piece.coefficients.col(1) = read.vec3(m.c2, -kMaxAcceleration, kMaxAcceleration);
  piece.coefficients.col(2) = read.vec3(m.c1, -kMaxSpeed, kMaxSpeed);
  piece.coefficients.col(3) = read.position(m.c0);
  return piece;
}

bool rests(const std::vector<CubicPiece>& pieces) {
  return pieces.size() == 1 && pieces.front().coefficients.leftCols<3>().isZero(0.0);
}

AlphaShares read_shares(wire::FieldReader& read, const tern_msgs::alpha_shares_t& m) {
  AlphaShares shares{};
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k] = static_cast<float>(read.number(m.at[k], wire::kAboveZero, 1.0));
    read.consistent(k == 0 || m.at[k] <= m.at[k - 1]);
  }
  return shares;
}

Track read_track(wire::FieldReader& read, const tern_msgs::track_t& m, wire::Slices<tern_msgs::track_piece_t>& pieces,
                 wire::Slices<tern_msgs::alpha_shares_t>& shares) {
  Track track;
  track.id = read.counter(m.id);
  track.kind = read.enumeration(m.kind, TrackKind::Estimated);
  track.half_extents = read.extents(m.half_extents);
  track.motion.start = read.time(m.start_us);
  track.top_speed = read.number(m.top_speed, 0.0, kMaxSpeed);
  const int count = read.integer(m.piece_count, 1, kMaxPiecesPerBatch);
  for (const tern_msgs::track_piece_t& piece : pieces.take(static_cast<std::size_t>(count))) {
    track.motion.pieces.push_back(read_piece(read, piece));
    track.alpha.push_back(read.extents(piece.alpha));
  }
  if (track.kind == TrackKind::Estimated) {
    for (const tern_msgs::alpha_shares_t& share : shares.take(static_cast<std::size_t>(count)))
      track.shares.push_back(read_shares(read, share));
  }
  if (track.kind == TrackKind::Static) read.consistent(rests(track.motion.pieces));
  return track;
}

tl::expected<TrackSet, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  TrackSet set;
  set.header = read.header(m.header);
  set.batch = read.batch(m.batch);
  set.made_at = read.time(m.made_at_us);
  set.confidence = read.number(m.confidence, wire::kAboveZero, 1.0);
  set.left_out = read.integer(m.left_out, 0, std::numeric_limits<std::int32_t>::max());
  wire::Slices pieces(m.pieces);
  wire::Slices shares(m.shares);
  std::vector<std::int64_t> ids;
  for (const tern_msgs::track_t& track : m.tracks) {
    set.tracks.push_back(read_track(read, track, pieces, shares));
    ids.push_back(set.tracks.back().id);
  }
  read.consistent(pieces.complete() && shares.complete());
  read.consistent(wire::all_different(std::move(ids)));
  return read.accept(std::move(set));
}

}  // namespace

template <>
Bytes encode(const TrackSet& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<TrackSet, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
