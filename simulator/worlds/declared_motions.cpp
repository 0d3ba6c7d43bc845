#include "simulator/worlds/declared_motions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

namespace tern {
namespace {

constexpr std::int64_t kMaxPieceUs = 2'000'000;
constexpr std::int64_t kEverUs = std::numeric_limits<std::int64_t>::max() / 4;

/// An interval of world time.
struct Span {
  Duration from, to;
  [[nodiscard]] bool empty() const { return from >= to; }
};

Span intersection(const Span& a, const Span& b) { return {std::max(a.from, b.from), std::min(a.to, b.to)}; }

/// Largest multiple of `step` that is ≤ t.
Duration floor_to(Duration t, Duration step) {
  const std::int64_t rest = ((t.us % step.us) + step.us) % step.us;
  return {t.us - rest};
}

class TrackMaker {
 public:
  /// @param coarse  may be null
  TrackMaker(const WorldObstacle& obstacle, UTime world_zero, Span wanted, const CoarseMotion* coarse)
      : obstacle_(obstacle), zero_(world_zero), wanted_(wanted), coarse_(coarse) {}

  /// @return nullopt if the obstacle is absent all the time
  std::optional<Track> make() {
    track_.id = obstacle_.id();
    track_.kind = TrackKind::Declared;
    track_.half_extents = obstacle_.half_extents();
    track_.top_speed = obstacle_.bounds().speed.maxCoeff();
    if (wanted_.from < Duration{}) straight({wanted_.from, std::min(wanted_.to, Duration{})}, Vec3::Zero());
    const Span later = {std::max(wanted_.from, Duration{}), wanted_.to};
    if (!later.empty()) add(later);
    if (track_.motion.pieces.empty()) return std::nullopt;
    return std::move(track_);
  }

 private:
  /// One piece with constant velocity from where the obstacle is at span.from, as far as it is present.
  void straight(const Span& span, const Vec3& v) {
    const Span present = intersection(span, presence());
    if (present.empty()) return;
    CubicPiece piece;
    piece.duration = present.to - present.from;
    piece.coefficients.col(2) = v;
    piece.coefficients.col(3) = obstacle_.at(present.from.seconds()).p;
    push(present.from, piece, Vec3::Constant(kFitRounding));
  }

  void push(Duration from, const CubicPiece& piece, const Vec3& alpha) {
    begin(from);
    track_.motion.pieces.push_back(piece);
    track_.alpha.push_back(alpha);
  }

  [[nodiscard]] Span presence() const {
    Span all = {Duration{-kEverUs}, Duration{kEverUs}};
    if (std::isfinite(obstacle_.first_s())) all.from = Duration::from_seconds(obstacle_.first_s());
    if (std::isfinite(obstacle_.last_s())) all.to = Duration::from_seconds(obstacle_.last_s());
    return all;
  }

  template <class Kind>
  [[nodiscard]] const Kind* coarse() const {
    return coarse_ == nullptr ? nullptr : std::get_if<Kind>(coarse_);
  }

  void begin(Duration t) {
    if (track_.motion.pieces.empty()) track_.motion.start = zero_ + t;
  }

  /// The motion, once the world moves.
  void add(const Span& span) {
    if (const auto* places = coarse<Box>()) return somewhere_in(*places, span);
    std::visit([&](const auto& m) { add(m, span); }, obstacle_.spec().motion);
  }

  void add(const StaticMotion&, const Span& span) { straight(span, Vec3::Zero()); }

  void add(const LinearMotion& m, const Span& span) {
    const Duration corner = Duration::from_seconds(m.from_s);
    straight({span.from, std::min(span.to, corner)}, Vec3::Zero());
    straight({std::max(span.from, corner), span.to}, m.velocity);
  }

  void add(const WaypointMotion& m, const Span& span) {
    const Duration first = Duration::from_seconds(m.points.front().first);
    const Duration last = Duration::from_seconds(m.points.back().first);
    Duration shift{};
    if (m.repeat) {
      shift = floor_to(span.from - first, last - first);
    } else {
      straight({span.from, std::min(span.to, first)}, Vec3::Zero());
    }
    const auto* way = coarse<Track>();
    do {
      way != nullptr ? coarse_pieces(*way, span, shift) : segments(m, span, shift);
      shift = shift + (last - first);
    } while (m.repeat && first + shift < span.to);
    if (!m.repeat) straight({std::max(span.from, last), span.to}, Vec3::Zero());
  }

  /// The segments of one round, later by `shift`, that meet the span; whole ones, but none begins before world time 0.
  void segments(const WaypointMotion& m, const Span& span, Duration shift) {
    for (std::size_t i = 0; i + 1 < m.points.size(); ++i) {
      const Span segment = {Duration::from_seconds(m.points[i].first) + shift,
                            Duration::from_seconds(m.points[i + 1].first) + shift};
      if (intersection(segment, span).empty()) continue;
      const Vec3 v = (m.points[i + 1].second - m.points[i].second) / (m.points[i + 1].first - m.points[i].first);
      straight({std::max(segment.from, Duration{}), segment.to}, v);
    }
  }

  /// As segments(), of what they were resampled to.
  void coarse_pieces(const Track& way, const Span& span, Duration shift) {
    Duration begin = way.motion.start - UTime{} + shift;
    for (std::size_t k = 0; k < way.motion.pieces.size(); ++k) {
      CubicPiece piece = way.motion.pieces[k];
      const Duration end = begin + piece.duration;
      const Duration from = std::max(begin, Duration{});
      if (!intersection({from, end}, span).empty()) {
        if (from > begin) {
          const double cut_s = (from - begin).seconds();
          piece = {end - from, reparametrized(piece.coefficients, cut_s, cut_s + 1.0)};
        }
        push(from, piece, way.alpha[k] + Vec3::Constant(kFitRounding));
      }
      begin = end;
    }
  }

  void somewhere_in(const Box& places, const Span& span) {
    const Span present = intersection(span, presence());
    if (present.empty()) return;
    CubicPiece piece{present.to - present.from, PowerCubic::Zero()};
    piece.coefficients.col(3) = places.center();
    push(present.from, piece, 0.5 * places.sizes() + Vec3::Constant(kFitRounding));
  }

  template <class Oscillation>
  void add(const Oscillation&, const Span& span) {
    if (!obstacle_.moves()) return straight(span, Vec3::Zero());
    const auto* coarser = coarse<Duration>();
    const Duration h = coarser != nullptr ? *coarser : fit_piece(obstacle_.bounds());
    const Duration grid_from = floor_to(span.from, h);
    const int pieces = static_cast<int>((span.to - grid_from + h - Duration{1}).us / h.us);
    begin(grid_from);
    const PiecewiseCubic fit = hermite_fit(zero_ + grid_from, h, pieces, [&](Duration since) {
      const ObstacleState s = obstacle_.at((grid_from + since).seconds());
      return MotionSample{s.p, s.v, Vec3::Zero(), Vec3::Zero()};
    });
    Vec3 alpha;
    for (int i = 0; i < 3; ++i)
      alpha[i] = hermite_error_bound(h.seconds(), obstacle_.bounds().fourth[i]) + kFitRounding;
    track_.motion.pieces.insert(track_.motion.pieces.end(), fit.pieces.begin(), fit.pieces.end());
    track_.alpha.insert(track_.alpha.end(), fit.pieces.size(), alpha);
  }

  const WorldObstacle& obstacle_;
  UTime zero_;
  Span wanted_;
  const CoarseMotion* coarse_;
  Track track_;
};

Track static_track(const WorldObstacle& obstacle, UTime from, UTime to) {
  Track track;
  track.id = obstacle.id();
  track.kind = TrackKind::Static;
  track.half_extents = obstacle.half_extents();
  track.motion.start = from;
  CubicPiece piece;
  piece.duration = to - from;
  piece.coefficients.col(3) = obstacle.at(0.0).p;
  track.motion.pieces = {piece};
  track.alpha = {Vec3::Zero()};
  return track;
}

}  // namespace

Duration fit_piece(const ObstacleBounds& bounds) {
  const double h = std::pow(384.0 * kFitError / bounds.fourth.maxCoeff(), 0.25);
  constexpr std::int64_t kMaxUnits = kMaxPieceUs / kGridUnit.us;
  const double units = std::min(std::floor(h * 1e6 / kGridUnit.us), static_cast<double>(kMaxUnits));
  return kGridUnit * std::max<std::int64_t>(1, static_cast<std::int64_t>(units));
}

TrackSet declare_motions(const World& world, UTime world_zero, UTime from, UTime to, const CoarseMotions& coarse) {
  if (!(from < to)) {
    throw std::invalid_argument("motions declared from " + std::to_string(from.us) + " us to " + std::to_string(to.us));
  }
  TrackSet set;
  set.made_at = from;
  for (const WorldObstacle& o : world.obstacles) {
    if (!o.moves() && !std::isfinite(o.first_s()) && !std::isfinite(o.last_s())) {
      set.tracks.push_back(static_track(o, from, to));
      continue;
    }
    const auto found = coarse.find(o.id());
    const CoarseMotion* motion = found == coarse.end() ? nullptr : &found->second;
    auto track = TrackMaker(o, world_zero, {from - world_zero, to - world_zero}, motion).make();
    if (track) set.tracks.push_back(std::move(*track));
  }
  return set;
}

}  // namespace tern
