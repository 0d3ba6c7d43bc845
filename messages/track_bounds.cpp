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
    io.header("header", m.header, of.header);
    io.time("at_us", m.at_us, of.at);
    io.number("confidence", m.confidence, of.confidence, kAboveZero, 1.0);
    io.integer("left_out", m.left_out, of.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.list("bounds", m.bounds, of.bounds, [&io](auto& b, auto& bound) {
      io.counter("id", b.id, bound.id);
      io.enumeration("kind", b.kind, bound.kind, MotionKind::Resting);
      io.enumeration("ruled_by", b.ruled_by, bound.ruled_by, BoundRule::Reach);
      io.number("ahead", b.ahead, bound.ahead_s, 0.0, kMaxCoordinate);
      io.number("model", b.model, bound.model, 0.0, kMaxCoordinate);
      io.number("measured", b.measured, bound.measured, 0.0, kMaxCoordinate);
      io.number("promised", b.promised, bound.promised, 0.0, kMaxCoordinate);
      io.number("evidence", b.evidence, bound.evidence, 0.0, kMaxCoordinate);
    });
  }
};

template Bytes encode(const TrackBounds& value);
template tl::expected<TrackBounds, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<TrackBounds>(std::span<const std::uint8_t> bytes);

}  // namespace tern
