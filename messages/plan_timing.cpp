#include "messages/form.h"
#include "tern_msgs/plan_timing_t.hpp"

namespace tern {

template <>
struct wire::Form<PlanTiming> {
  using Message = tern_msgs::plan_timing_t;
  static_assert(sizeof(Message::stage_ms) == sizeof(PlanTiming::stage_ms));
  static constexpr Layout<Message> kLayout{};

  static void fields(auto& io, auto& m, auto& timing) {
    const auto milliseconds = [&io](const char* name, auto& field, auto& x) { io.number(name, field, x, 0.0, 1e9); };
    io.header("header", m.header, timing.header);
    io.integer("request_id", m.request_id, timing.request_id, 1, kMaxCounter);
    milliseconds("total_ms", m.total_ms, timing.total_ms);
    milliseconds("first_answer_ms", m.first_answer_ms, timing.first_answer_ms);
    milliseconds("cpu_ms", m.cpu_ms, timing.cpu_ms);
    for (int stage = 0; stage < kStages; ++stage) milliseconds("stage_ms", m.stage_ms[stage], timing.stage_ms[stage]);
    io.counter("expansions", m.expansions, timing.expansions);
    io.counter("hulls", m.hulls, timing.hulls);
    io.counter("pairs_by_index", m.pairs_by_index, timing.pairs_by_index);
    io.counter("pairs_by_box", m.pairs_by_box, timing.pairs_by_box);
    io.counter("pairs_by_instant", m.pairs_by_instant, timing.pairs_by_instant);
    io.counter("pairs_by_cache", m.pairs_by_cache, timing.pairs_by_cache);
    io.counter("pairs_by_plane", m.pairs_by_plane, timing.pairs_by_plane);
    io.counter("pairs_by_lp", m.pairs_by_lp, timing.pairs_by_lp);
    io.counter("solver_calls", m.solver_calls, timing.solver_calls);
    io.counter("solver_iterations", m.solver_iterations, timing.solver_iterations);
    io.counter("peak_rss_kb", m.peak_rss_kb, timing.peak_rss_kb);
    io.flag("from_watchdog", m.from_watchdog, timing.from_watchdog);
  }
};

template Bytes encode(const PlanTiming& value);
template tl::expected<PlanTiming, Rejection> decode(std::span<const std::uint8_t> bytes);
template std::string refused_field<PlanTiming>(std::span<const std::uint8_t> bytes);

}  // namespace tern
