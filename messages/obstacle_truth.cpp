#include "messages/form.h"
#include "tern_msgs/obstacle_truth_t.hpp"

namespace tern {

template <>
struct wire::Form<ObstacleTruth> {
  using Message = tern_msgs::obstacle_truth_t;
  static_assert(Message::MAX_OBSTACLES == kMaxObstaclesPerBatch);
  static constexpr Layout kLayout{
      Array{&Message::obstacle_count, &Message::obstacles, 0, kMaxObstaclesPerBatch},
  };

  static void fields(auto& io, auto& m, auto& truth) {
    io.header("header", m.header, truth.header);
    io.batch("batch", m.batch, truth.batch);
    io.time("at_us", m.at_us, truth.at);
    io.integer("left_out", m.left_out, truth.left_out, 0, std::numeric_limits<std::int32_t>::max());
    io.list("obstacles", m.obstacles, truth.obstacles, [&io](auto& o, auto& obstacle) {
      io.counter("id", o.id, obstacle.id);
      io.position("position", o.position, obstacle.position);
      io.vec3("velocity", o.velocity, obstacle.velocity, -kMaxSpeed, kMaxSpeed);
      io.extents("half_extents", o.half_extents, obstacle.half_extents);
      io.flag("moves", o.moves, obstacle.moves);
    });
  }

  static void read_rest(FieldReader& read, const Message& m, ObstacleTruth&) {
    std::vector<std::int64_t> ids;
    for (const tern_msgs::true_obstacle_t& o : m.obstacles) ids.push_back(o.id);
    read.all_different(std::move(ids), "two obstacles have the id");
  }
};

template Bytes encode(const ObstacleTruth& value);
template tl::expected<ObstacleTruth, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<ObstacleTruth>(std::span<const std::uint8_t> bytes);

}  // namespace tern
