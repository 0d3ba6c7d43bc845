#include "messages/form.h"
#include "tern_msgs/track_bounds_t.hpp"

namespace tern {

template <>
struct wire::Form<TrackBounds> {
  using Message = tern_msgs::track_bounds_t;
  static_assert(Message::MAX_BOUNDS == kMaxTrackBounds);
  static constexpr Layout kLayout{
      Array{&Message::bound_count, &Message::bounds, 0, kMaxTrackBounds},
  };

  static void fields(auto& io, auto& m, auto& of) {
    io.header(m.header, of.header);
    io.time(m.at_us, of.at);
    io.number(m.confidence, of.confidence, kAboveZero, 1.0);
    io.integer(m.left_out, of.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.list(m.bounds, of.bounds, [&io](auto& b, auto& bound) {
      io.counter(b.id, bound.id);
      io.enumeration(b.kind, bound.kind, MotionKind::Resting);
      io.enumeration(b.ruled_by, bound.ruled_by, BoundRule::Reach);
      io.number(b.ahead, bound.ahead_s, 0.0, kMaxCoordinate);
      io.number(b.model, bound.model, 0.0, kMaxCoordinate);
      io.number(b.measured, bound.measured, 0.0, kMaxCoordinate);
      io.number(b.promised, bound.promised, 0.0, kMaxCoordinate);
      io.number(b.evidence, bound.evidence, 0.0, kMaxCoordinate);
    });
  }
};

template Bytes encode(const TrackBounds& value);
template tl::expected<TrackBounds, Rejection> decode(std::span<const std::uint8_t> bytes);

}  // namespace tern
