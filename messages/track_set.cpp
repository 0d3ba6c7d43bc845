#include "messages/batching.h"
#include "messages/form.h"
#include "tern_msgs/track_set_t.hpp"

namespace tern {
namespace {

/// @throws std::invalid_argument unless a track has one α per piece, and shares per piece exactly if it is estimated
void require_complete(const Track& track) {
  const std::size_t pieces = track.motion.pieces.size();
  const std::string name = "track " + std::to_string(track.id);
  if (track.alpha.size() != pieces) throw std::invalid_argument(name + ": a track needs one alpha per piece");
  if (track.shares.size() != (track.kind == TrackKind::Estimated ? pieces : 0)) {
    throw std::invalid_argument(name + ": an estimated track needs shares for each piece, any other track none");
  }
}

bool rests(const std::vector<CubicPiece>& pieces) {
  return pieces.size() == 1 && pieces.front().coefficients.leftCols<3>().isZero(0.0);
}

tern_msgs::track_piece_t write_piece(const CubicPiece& piece, const Vec3& alpha) {
  tern_msgs::track_piece_t m{};
  m.duration_us = piece.duration.us;
  m.c3 = wire::to_lcm(Vec3(piece.coefficients.col(0)));
  m.c2 = wire::to_lcm(Vec3(piece.coefficients.col(1)));
  m.c1 = wire::to_lcm(Vec3(piece.coefficients.col(2)));
  m.c0 = wire::to_lcm(Vec3(piece.coefficients.col(3)));
  m.alpha = wire::to_lcm(alpha);
  return m;
}

CubicPiece read_piece(wire::FieldReader& read, const tern_msgs::track_piece_t& m) {
  CubicPiece piece;
  piece.duration = read.named("duration_us").duration(m.duration_us, Duration{1}, kMaxSpan);
  piece.coefficients.col(0) = read.named("c3").vec3(m.c3, -kMaxJerk, kMaxJerk);
  piece.coefficients.col(1) = read.named("c2").vec3(m.c2, -kMaxAcceleration, kMaxAcceleration);
  piece.coefficients.col(2) = read.named("c1").vec3(m.c1, -kMaxSpeed, kMaxSpeed);
  piece.coefficients.col(3) = read.named("c0").position(m.c0);
  return piece;
}

// @param of_piece  the shares of all axes, or of each axis; of a damaged message none
AlphaShares read_shares(wire::FieldReader& read, std::span<const tern_msgs::alpha_shares_t> of_piece) {
  AlphaShares shares{};
  for (std::size_t axis = 0; axis < of_piece.size(); ++axis) {
    const tern_msgs::alpha_shares_t& m = of_piece[axis];
    for (std::size_t k = 0; k < shares.size(); ++k) {
      shares[k][axis] = static_cast<float>(read.named("shares").number(m.at[k], wire::kAboveZero, 1.0));
      read.consistent(k == 0 || m.at[k] <= m.at[k - 1], "shares of alpha grow");
      if (of_piece.size() == 1) shares[k].fill(shares[k][axis]);
    }
  }
  return shares;
}

std::size_t estimated_pieces(const tern_msgs::track_set_t& m) {
  std::size_t pieces = 0;
  for (const tern_msgs::track_t& track : m.tracks) {
    if (track.kind == tern_msgs::track_t::ESTIMATED) pieces += static_cast<std::size_t>(std::max(0, track.piece_count));
  }
  return pieces;
}

}  // namespace

template <>
struct wire::Form<TrackSet> {
  using Message = tern_msgs::track_set_t;
  static_assert(Message::MAX_TRACKS == kMaxTracksPerBatch);
  static_assert(Message::MAX_PIECES == kMaxPiecesPerBatch);
  static constexpr Layout kLayout{
      Array{&Message::track_count, &Message::tracks, 0, kMaxTracksPerBatch},
      Array{&Message::piece_count, &Message::pieces, 0, kMaxPiecesPerBatch},
      Array{&Message::share_count, &Message::shares, 0, 3 * kMaxPiecesPerBatch},
  };

  static void fields(auto& io, auto& m, auto& set) {
    io.header("header", m.header, set.header);
    io.batch("batch", m.batch, set.batch);
    io.time("made_at_us", m.made_at_us, set.made_at);
    io.number("confidence", m.confidence, set.confidence, kAboveZero, 1.0);
    io.integer("left_out", m.left_out, set.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.list("tracks", m.tracks, set.tracks, [&io](auto& t, auto& track) {
      io.counter("id", t.id, track.id);
      io.enumeration("kind", t.kind, track.kind, TrackKind::Estimated);
      io.extents("half_extents", t.half_extents, track.half_extents);
      io.time("start_us", t.start_us, track.motion.start);
      io.number("top_speed", t.top_speed, track.top_speed, 0.0, kMaxSpeed);
    });
  }

  static void write_rest(Message& m, const TrackSet& set) {
    const std::size_t axes = std::ranges::all_of(set.tracks, is_same_on_all_axes) ? 1 : 3;
    for (std::size_t k = 0; k < set.tracks.size(); ++k) {
      const Track& track = set.tracks[k];
      require_complete(track);
      m.tracks[k].piece_count = static_cast<std::int32_t>(track.motion.pieces.size());
      for (std::size_t i = 0; i < track.alpha.size(); ++i)
        m.pieces.push_back(write_piece(track.motion.pieces[i], track.alpha[i]));
      for (const AlphaShares& shares : track.shares) {
        for (std::size_t axis = 0; axis < axes; ++axis) {
          tern_msgs::alpha_shares_t& to = m.shares.emplace_back();
          for (std::size_t level = 0; level < shares.size(); ++level) to.at[level] = shares[level][axis];
        }
      }
    }
  }

  static void read_rest(FieldReader& read, const Message& m, TrackSet& set) {
    Slices pieces(m.pieces);
    Slices shares(m.shares);
    const std::size_t axes = m.shares.size() == estimated_pieces(m) ? 1 : 3;
    std::vector<std::int64_t> ids;
    for (std::size_t k = 0; k < set.tracks.size(); ++k) {
      Track& track = set.tracks[k];
      read.enter("tracks", k);
      const std::int32_t piece_count = m.tracks[k].piece_count;
      const auto count =
          static_cast<std::size_t>(read.named("piece_count").integer(piece_count, 1, kMaxPiecesPerBatch));
      for (const tern_msgs::track_piece_t& piece : pieces.take(count)) {
        track.motion.pieces.push_back(read_piece(read, piece));
        track.alpha.push_back(read.named("alpha").extents(piece.alpha));
      }
      if (track.kind == TrackKind::Estimated) {
        for (std::size_t piece = 0; piece < count; ++piece)
          track.shares.push_back(read_shares(read, shares.take(axes)));
      }
      if (track.kind == TrackKind::Static)
        read.consistent(rests(track.motion.pieces), "a static track moves, or has several pieces");
      ids.push_back(track.id);
    }
    read.leave();
    read.consistent(pieces.complete() && shares.complete(), "the tracks' piece counts do not sum to the pieces");
    read.all_different(std::move(ids), "two tracks have the id");
  }
};

template Bytes encode(const TrackSet& value);
template tl::expected<TrackSet, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<TrackSet>(std::span<const std::uint8_t> bytes);

}  // namespace tern
