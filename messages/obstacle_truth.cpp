#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/obstacle_truth_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::obstacle_truth_t;
static_assert(Message::MAX_OBSTACLES == kMaxObstaclesPerBatch);

const wire::Layout kLayout{
    wire::Array{&Message::obstacle_count, &Message::obstacles, 0, kMaxObstaclesPerBatch},
};

tern_msgs::true_obstacle_t to_lcm(const TrueObstacle& obstacle) {
  tern_msgs::true_obstacle_t m{};
  m.id = obstacle.id;
  m.position = wire::to_lcm(obstacle.position);
  m.velocity = wire::to_lcm(obstacle.velocity);
  m.half_extents = wire::to_lcm(obstacle.half_extents);
  m.moves = obstacle.moves;
  return m;
}

Message to_lcm(const ObstacleTruth& truth) {
  Message m{};
  m.header = wire::to_lcm(truth.header);
  m.batch = wire::to_lcm(truth.batch);
  m.at_us = truth.at.us;
  m.left_out = truth.left_out;
  for (const TrueObstacle& obstacle : truth.obstacles) m.obstacles.push_back(to_lcm(obstacle));
  return m;
}

tl::expected<ObstacleTruth, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  ObstacleTruth truth;
  truth.header = read.header(m.header);
  truth.batch = read.batch(m.batch);
  truth.at = read.time(m.at_us);
  truth.left_out = read.integer(m.left_out, 0, std::numeric_limits<std::int32_t>::max());
  std::vector<std::int64_t> ids;
  for (const tern_msgs::true_obstacle_t& o : m.obstacles) {
    truth.obstacles.push_back({read.counter(o.id), read.position(o.position),
                               read.vec3(o.velocity, -kMaxSpeed, kMaxSpeed), read.extents(o.half_extents),
                               read.flag(o.moves)});
    ids.push_back(o.id);
  }
  read.consistent(wire::all_different(std::move(ids)));
  return read.accept(std::move(truth));
}

}  // namespace

template <>
Bytes encode(const ObstacleTruth& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<ObstacleTruth, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
