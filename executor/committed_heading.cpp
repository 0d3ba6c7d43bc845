#include "executor/committed_heading.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tern {

const char* to_string(HeadingVerdict verdict) {
  constexpr const char* kNames[kHeadingVerdicts] = {"adopted", "unknown plan", "late", "off the plan's knots",
                                                    "unflyable"};
  return kNames[static_cast<int>(verdict)];
}

void CommittedHeading::await(const Plan& plan, UTime t_s) {
  awaited_ = Awaited{plan.request_id, plan.inputs.request, t_s, plan.trajectory.interval,
                     static_cast<std::size_t>(plan.trajectory.control_points.cols())};
}

void CommittedHeading::on_adopted(const Plan& plan, UTime t_s) {
  await(plan, t_s);
  begin(t_s, std::nullopt);
}

void CommittedHeading::on_kept(const Plan& plan, UTime t_s) { await(plan, t_s); }

void CommittedHeading::begin(UTime from, std::optional<HeadingSpline> heading) {
  drop_from(from);
  if (heading || !segments_.empty()) segments_.push_back({from, std::move(heading)});
}

std::optional<YawSample> CommittedHeading::sample_from(UTime latest, UTime t) const {
  const auto begun = [latest](const Segment& s) { return s.from <= latest; };
  const auto found = std::find_if(segments_.rbegin(), segments_.rend(), begun);
  if (found == segments_.rend() || !found->heading) return std::nullopt;
  return found->heading->sample(t);
}

std::optional<YawSample> CommittedHeading::sample(UTime t) const { return sample_from(t, t); }

HeadingAdoption CommittedHeading::judge(const PlanHeading& heading, UTime now) {
  if (!awaited_ || heading.request_id != awaited_->request_id || heading.request != awaited_->request) {
    return {HeadingVerdict::UnknownPlan, fmt::format("request {}", heading.request_id)};
  }
  const Awaited plan = *std::exchange(awaited_, std::nullopt);
  const auto joins = sample_from(plan.t_s - Duration{1}, plan.t_s);
  begin(plan.t_s, std::nullopt);
  if (heading.start != plan.t_s || heading.interval != plan.interval ||
      heading.control_points.size() != plan.control_points) {
    return {HeadingVerdict::OffKnots,
            fmt::format("starts {} us after t_s; {} control points {} us apart, the plan has {} and {} us",
                        (heading.start - plan.t_s).us, heading.control_points.size(), heading.interval.us,
                        plan.control_points, plan.interval.us)};
  }
  if (now >= plan.t_s) {
    return {HeadingVerdict::Late, fmt::format("{:.1f} ms after its start", (now - plan.t_s).seconds() * 1e3)};
  }
  const HeadingBreachReport report = heading_breach(heading, limits_, joins);
  if (!report.ok()) return {HeadingVerdict::Unflyable, report.text, report.breach};
  if (!joins) ++counters_.started_anew;
  begin(plan.t_s, HeadingSpline(heading));
  return {};
}

HeadingAdoption CommittedHeading::consider(const PlanHeading& heading, UTime now) {
  HeadingAdoption adoption = judge(heading, now);
  ++counters_.verdicts[idx(adoption.verdict)];
  if (adoption.verdict == HeadingVerdict::Unflyable) ++counters_.breaches[idx(adoption.breach)];
  return adoption;
}

void CommittedHeading::drop_from(UTime t) {
  while (!segments_.empty() && segments_.back().from >= t) segments_.pop_back();
}

void CommittedHeading::clear() {
  segments_.clear();
  awaited_.reset();
}

void CommittedHeading::forget_before(UTime t) {
  while (segments_.size() > 1 && segments_[1].from <= t) segments_.pop_front();
}

}  // namespace tern
