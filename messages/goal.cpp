#include "messages/form.h"
#include "tern_msgs/goal_t.hpp"

namespace tern {

template <>
struct wire::Form<Goal> {
  using Message = tern_msgs::goal_t;
  static_assert(Message::STOP == static_cast<int>(GoalMode::Stop));
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& goal) {
    io.header("header", m.header, goal.header);
    io.integer("id", m.id, goal.id, 1, kMaxGoalId);
    io.enumeration("mode", m.mode, goal.mode, GoalMode::Stop);
    io.position("position", m.position, goal.position);
  }
};

template Bytes encode(const Goal& value);
template tl::expected<Goal, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<Goal>(std::span<const std::uint8_t> bytes);

}  // namespace tern
