#include "core/world/landmark_densities.h"

#include "messages/form.h"
#include "tern_msgs/landmark_densities_t.hpp"

namespace tern {

template <>
struct wire::Form<LandmarkDensities> {
  using Message = tern_msgs::landmark_densities_t;
  static_assert(Message::MAX_CLASSES == kMaxSurfaceClasses);
  static constexpr Layout kLayout{Array{&Message::class_count, &Message::by_class, 1, kMaxSurfaceClasses}};

  static void fields(auto& io, auto& m, auto& of) {
    io.header("header", m.header, of.header);
    io.any("statics", m.statics, of.statics);
    io.any("tracks", m.tracks, of.tracks);
    io.any("map_version", m.map_version, of.map_version);
    io.number("obstacles", m.obstacles, of.densities.obstacles, 0.0, kMaxLandmarkDensity);
    io.list("by_class", m.by_class, of.densities.by_class,
            [&io](auto& x, auto& density) { io.number("density", x, density, 0.0, kMaxLandmarkDensity); });
  }

  static void read_rest(FieldReader& read, const Message&, LandmarkDensities& of) {
    read.consistent(of.statics == name_of(of), "statics is not the digest of the rest");
  }
};

template Bytes encode(const LandmarkDensities& value);
template tl::expected<LandmarkDensities, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<LandmarkDensities>(std::span<const std::uint8_t> bytes);

}  // namespace tern
