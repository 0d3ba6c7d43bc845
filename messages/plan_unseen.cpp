#include "core/world/plan_unseen.h"

#include "messages/form.h"
#include "tern_msgs/plan_unseen_t.hpp"

namespace tern {

template <>
struct wire::Form<PlanUnseen> {
  using Message = tern_msgs::plan_unseen_t;
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& unseen) {
    io.header("header", m.header, unseen.header);
    io.integer("request_id", m.request_id, unseen.request_id, 1, kMaxCounter);
    io.name("request", m.request, unseen.request);
    io.time("start_us", m.start_us, unseen.start);
    io.duration("committed_clear_us", m.committed_clear_us, unseen.committed_clear, Duration{0}, kMaxSpan);
    io.duration("plan_clear_us", m.plan_clear_us, unseen.plan_clear, Duration{0}, kMaxSpan);
  }
};

template Bytes encode(const PlanUnseen& value);
template tl::expected<PlanUnseen, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<PlanUnseen>(std::span<const std::uint8_t> bytes);

}  // namespace tern
