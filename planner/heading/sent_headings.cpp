#include "planner/heading/sent_headings.h"

#include <algorithm>

namespace tern {
namespace {

/// At 20 Hz, the plans of three seconds. An older committed trajectory has ended, or was kept and has newer headings.
constexpr std::size_t kRemembered = 64;

bool same(const TimedSpline& a, const TimedSpline& b) {
  return a.start == b.start && a.interval == b.interval && a.control_points.cols() == b.control_points.cols() &&
         a.control_points == b.control_points;
}

}  // namespace

void SentHeadings::add(const TimedSpline& trajectory, const PlanHeading& heading) {
  sent_.push_back({trajectory, HeadingSpline(heading)});
  if (sent_.size() > kRemembered) sent_.pop_front();
}

std::optional<YawSample> SentHeadings::committed_at(const HorizonRequest& request) const {
  const auto found =
      std::find_if(sent_.rbegin(), sent_.rend(), [&](const Sent& s) { return same(s.trajectory, request.committed); });
  if (found == sent_.rend()) return std::nullopt;
  return found->heading.sample(request.t_s);
}

}  // namespace tern
