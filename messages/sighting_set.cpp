#include <algorithm>
#include <numbers>

#include "core/world/sighting.h"
#include "messages/form.h"
#include "messages/quaternion_fields.h"
#include "tern_msgs/sighting_set_t.hpp"

namespace tern {

template <>
struct wire::Form<SightingSet> {
  using Message = tern_msgs::sighting_set_t;
  static_assert(Message::MAX_SIGHTINGS == kMaxSightings && Message::MAX_CELLS == kMaxViewCells);
  static_assert(Message::BLIND == kBlindDepth && Message::FAR == kFarDepth);
  static_assert(Message::SPHERICAL == static_cast<int>(ViewKind::Spherical));
  static_assert(tern_msgs::sighting_t::UNSEEN == static_cast<int>(BoundSight::Unseen));
  static constexpr Layout kLayout{
      Array{&Message::sighting_count, &Message::sightings, 0, kMaxSightings},
      Array{&Message::depth_count, &Message::depths, 0, kMaxViewCells},
  };
  static constexpr double kMaxUnit = 1e3;  // m

  static void fields(auto& io, auto& m, auto& set) {
    io.header("header", m.header, set.header);
    io.time("at_us", m.at_us, set.at);
    io.integer("sensor_id", m.sensor_id, set.sensor_id, 0, std::numeric_limits<std::int32_t>::max());
    io.integer("left_out", m.left_out, set.left_out, 0, std::numeric_limits<std::int32_t>::max());
    view_fields(io, m, set.view);
    io.list("sightings", m.sightings, set.sightings, [&io](auto& s, auto& sighting) {
      io.position("lower", s.lower, sighting.lower);
      io.position("upper", s.upper, sighting.upper);
      io.extents("lower_sigma", s.lower_sigma, sighting.lower_sigma);
      io.extents("upper_sigma", s.upper_sigma, sighting.upper_sigma);
      for (std::size_t k = 0; k < sighting.bounds.size(); ++k)
        io.enumeration("bounds", s.bounds[k], sighting.bounds[k], BoundSight::Unseen);
      io.integer("points", s.points, sighting.points, 1, std::numeric_limits<std::int32_t>::max());
    });
  }

  static void view_fields(auto& io, auto& m, auto& view) {
    io.enumeration("kind", m.kind, view.kind, ViewKind::Spherical);
    io.position("sensor_position", m.sensor_position, view.sensor_position);
    quaternion_fields(io, m, view.q_WC);
    io.number("left", m.left, view.left, 0.0, std::numbers::pi);
    io.number("right", m.right, view.right, 0.0, std::numbers::pi);
    io.number("up", m.up, view.up, 0.0, std::numbers::pi / 2);
    io.number("down", m.down, view.down, 0.0, std::numbers::pi / 2);
    io.number("near", m.near, view.near_m, 0.0, kMaxCoordinate);
    io.number("range", m.range, view.range_m, kAboveZero, kMaxCoordinate);
    io.number("depth_sigma", m.depth_sigma, view.depth_sigma, 0.0, kMaxCoordinate);
    io.number("depth_sigma_per_square_m", m.depth_sigma_per_square_m, view.depth_sigma_per_square_m, 0.0,
              kMaxCoordinate);
    io.number("unit", m.unit, view.unit_m, kAboveZero, kMaxUnit);
    io.integer("rows", m.rows, view.rows, 0, kMaxViewCells);
    io.integer("columns", m.columns, view.columns, 0, kMaxViewCells);
    io.any("depths", m.depths, view.depths);
  }

  static void read_rest(FieldReader& read, const Message&, SightingSet& set) {
    const SensorView& view = set.view;
    read.consistent(is_unit(view.q_WC), "the quaternion has not the length 1");
    read.consistent(std::ssize(view.depths) == std::int64_t{view.rows} * view.columns,
                    "the depths are not rows times columns");
    const bool narrow = view.kind == ViewKind::Spherical ||
                        std::max({view.left, view.right, view.up, view.down}) < std::numbers::pi / 2;
    read.consistent(narrow, "the field of view of a camera reaches to a right angle");
    for (const Sighting& sighting : set.sightings)
      read.consistent((sighting.lower.array() <= sighting.upper.array()).all(), "a lower bound is above its upper one");
  }
};

template Bytes encode(const SightingSet& value);
template tl::expected<SightingSet, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<SightingSet>(std::span<const std::uint8_t> bytes);

}  // namespace tern
