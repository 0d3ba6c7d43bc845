#include "messages/codec.h"
#include "messages/fields.h"
#include "messages/wire.h"
#include "tern_msgs/plan_timing_t.hpp"

namespace tern {
namespace {

using Message = tern_msgs::plan_timing_t;

const wire::Layout<Message> kLayout;
static_assert(sizeof(Message::stage_ms) == sizeof(PlanTiming::stage_ms));
constexpr double kMaxMilliseconds = 1e9;

Message to_lcm(const PlanTiming& timing) {
  Message m{};
  m.header = wire::to_lcm(timing.header);
  m.request_id = timing.request_id;
  m.total_ms = timing.total_ms;
  m.first_answer_ms = timing.first_answer_ms;
  m.cpu_ms = timing.cpu_ms;
  std::copy(std::begin(timing.stage_ms), std::end(timing.stage_ms), m.stage_ms);
  m.expansions = timing.expansions;
  m.hulls = timing.hulls;
  m.pairs_by_index = timing.pairs_by_index;
  m.pairs_by_box = timing.pairs_by_box;
  m.pairs_by_instant = timing.pairs_by_instant;
  m.pairs_by_cache = timing.pairs_by_cache;
  m.pairs_by_plane = timing.pairs_by_plane;
  m.pairs_by_lp = timing.pairs_by_lp;
  m.solver_calls = timing.solver_calls;
  m.solver_iterations = timing.solver_iterations;
  m.peak_rss_kb = timing.peak_rss_kb;
  m.from_watchdog = timing.from_watchdog;
  return m;
}

tl::expected<PlanTiming, Rejection> from_lcm(const Message& m) {
  wire::FieldReader read;
  const auto milliseconds = [&](double x) { return read.number(x, 0.0, kMaxMilliseconds); };
  PlanTiming timing;
  timing.header = read.header(m.header);
  timing.request_id = read.integer<std::int64_t>(m.request_id, 1, wire::kMaxCounter);
  timing.total_ms = milliseconds(m.total_ms);
  timing.first_answer_ms = milliseconds(m.first_answer_ms);
  timing.cpu_ms = milliseconds(m.cpu_ms);
  std::transform(std::begin(m.stage_ms), std::end(m.stage_ms), timing.stage_ms, milliseconds);
  timing.expansions = read.counter(m.expansions);
  timing.hulls = read.counter(m.hulls);
  timing.pairs_by_index = read.counter(m.pairs_by_index);
  timing.pairs_by_box = read.counter(m.pairs_by_box);
  timing.pairs_by_instant = read.counter(m.pairs_by_instant);
  timing.pairs_by_cache = read.counter(m.pairs_by_cache);
  timing.pairs_by_plane = read.counter(m.pairs_by_plane);
  timing.pairs_by_lp = read.counter(m.pairs_by_lp);
  timing.solver_calls = read.counter(m.solver_calls);
  timing.solver_iterations = read.counter(m.solver_iterations);
  timing.peak_rss_kb = read.counter(m.peak_rss_kb);
  timing.from_watchdog = read.flag(m.from_watchdog);
  return read.accept(std::move(timing));
}

}  // namespace

template <>
Bytes encode(const PlanTiming& value) {
  return wire::encode(to_lcm(value), kLayout);
}

template <>
tl::expected<PlanTiming, Rejection> decode(std::span<const std::uint8_t> bytes) {
  return wire::decode(bytes, kLayout, from_lcm);
}

}  // namespace tern
