#include "messages/form.h"
#include "tern_msgs/speed_limit_t.hpp"

namespace tern {

template <>
struct wire::Form<SpeedLimit> {
  using Message = tern_msgs::speed_limit_t;
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& limit) {
    io.header("header", m.header, limit.header);
    io.integer("goal_id", m.goal_id, limit.goal_id, 1, kMaxGoalId);
    io.vec3("v_max", m.v_max, limit.v_max, 0.05, kMaxSpeedLimit);  // a slower vehicle can evade nobody
  }
};

template Bytes encode(const SpeedLimit& value);
template tl::expected<SpeedLimit, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<SpeedLimit>(std::span<const std::uint8_t> bytes);

}  // namespace tern
