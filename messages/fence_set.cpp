#include <cmath>

#include "messages/form.h"
#include "tern_msgs/fence_set_t.hpp"

namespace tern {

namespace {

/// True for +0 alone: −0 would be another message.
bool is_blank(double x) { return x == 0.0 && !std::signbit(x); }

}  // namespace

template <>
struct wire::Form<FenceSet> {
  using Message = tern_msgs::fence_set_t;
  static_assert(Message::MAX_FENCES == kMaxFencesPerMessage);
  static_assert(Message::MAX_CORNERS == kMaxFenceCornersPerMessage);
  static constexpr Layout kLayout{
      Array{&Message::fence_count, &Message::fences, 0, kMaxFencesPerMessage},
      Array{&Message::corner_count, &Message::corners, 0, kMaxFenceCornersPerMessage},
  };

  static void fields(auto& io, auto& m, auto& set) {
    io.header("header", m.header, set.header);
    io.list("fences", m.fences, set.fences,
            [&io](auto& f, auto& fence) { io.flag("is_inclusion", f.is_inclusion, fence.is_inclusion); });
  }

  static void write_rest(Message& m, const FenceSet& set) {
    for (std::size_t k = 0; k < set.fences.size(); ++k) {
      tern_msgs::fence_t& fence = m.fences[k];
      if (const auto* polygon = std::get_if<FencePolygon>(&set.fences[k].shape)) {
        fence.corner_count = static_cast<std::int32_t>(polygon->corners.size());
        for (const Eigen::Vector2d& corner : polygon->corners) {
          tern_msgs::fence_corner_t& to = m.corners.emplace_back();
          to.x = corner.x();
          to.y = corner.y();
        }
        continue;
      }
      const auto& circle = std::get<FenceCircle>(set.fences[k].shape);
      fence.x = circle.centre.x();
      fence.y = circle.centre.y();
      fence.radius = circle.radius;
    }
  }

  static void read_rest(FieldReader& read, const Message& m, FenceSet& set) {
    const auto coordinate = [&read](const char* name, double x) {
      return read.named(name).number(x, -kMaxCoordinate, kMaxCoordinate);
    };
    Slices corners(m.corners);
    for (std::size_t k = 0; k < set.fences.size(); ++k) {
      const tern_msgs::fence_t& fence = m.fences[k];
      read.enter("fences", k);
      const bool is_circle = fence.corner_count == 0;
      const Eigen::Vector2d centre(coordinate("x", fence.x), coordinate("y", fence.y));
      const double radius =
          read.named("radius").number(fence.radius, is_circle ? kAboveZero : 0.0, is_circle ? kMaxCoordinate : 0.0);
      if (is_circle) {
        set.fences[k].shape = FenceCircle{centre, radius};
        continue;
      }
      FencePolygon polygon;
      const auto count = static_cast<std::size_t>(
          read.named("corner_count").integer(fence.corner_count, 3, kMaxFenceCornersPerMessage));
      for (const tern_msgs::fence_corner_t& corner : corners.take(count))
        polygon.corners.emplace_back(coordinate("corner.x", corner.x), coordinate("corner.y", corner.y));
      read.consistent(is_blank(fence.x) && is_blank(fence.y) && is_blank(fence.radius), "a polygon has a centre");
      set.fences[k].shape = std::move(polygon);
    }
    read.leave();
    read.consistent(corners.complete(), "the fences' corner counts do not sum to the corners");
  }
};

template Bytes encode(const FenceSet& value);
template tl::expected<FenceSet, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<FenceSet>(std::span<const std::uint8_t> bytes);

}  // namespace tern
