#include "monitor/certified_share.h"

#include <algorithm>

namespace tern {
namespace {

double seconds_between(UTime from, UTime to) { return std::max(0.0, (to - from).seconds()); }

}  // namespace

void CertifiedShare::add(const HorizonRequest& request) {
  open_.push_back({request.header.name, request.t_s});
  if (open_.size() <= kOpen) return;
  times_.add(seconds_between(open_[0].start, open_[1].start), open_[0].certified);
  open_.pop_front();
}

void CertifiedShare::add(const PlanUnseen& unseen) {
  reported_ = true;
  const auto request = std::ranges::find(open_, unseen.request, &Request::name);
  if (request != open_.end()) request->certified = unseen.committed_clear == kMaxSpan;
}

std::optional<double> CertifiedShare::until(UTime end) const {
  Times times = times_;
  for (std::size_t k = 0; k < open_.size(); ++k) {
    const UTime next = k + 1 < open_.size() ? open_[k + 1].start : end;
    times.add(seconds_between(open_[k].start, next), open_[k].certified);
  }
  if (!reported_ || times.all_s == 0.0) return std::nullopt;
  return times.certified_s / times.all_s;
}

}  // namespace tern
