#include "planner/semantics/error_price.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tern {

ErrorPrice::ErrorPrice(std::shared_ptr<const InformationMap> information, double price, double speed)
    : information_(std::move(information)), price_(price), speed_(speed) {
  if (!(speed > 0.0)) throw std::invalid_argument("the speed of a priced way is " + std::to_string(speed) + " m/s");
}

double ErrorPrice::extend(const Vec3& a, const Vec3& b, Drift& drift) const {
  const Vec3 step = b - a;
  const double length = step.norm();
  const int samples = static_cast<int>(length / kSample) + 1;
  const int heading = InformationMap::heading_of(step.x(), step.y());
  const double share = 1.0 / samples, part = share * length, seconds = part / speed_;
  const Vec3 between = share * step;
  Vec3 p = b - 0.5 * between;
  for (int k = 0; k < samples; ++k) {  // from b to a
    const Sight& sight = information_->sight(p, heading);
    drift.extend(part, seconds, static_cast<double>(sight.growth), static_cast<double>(sight.equal_dark_s));
    p -= between;
  }
  return cost(drift);
}

double ErrorPrice::cost(const Drift& drift) const { return drift.way + price_ * (drift.at_goal() + drift.at_worst()); }

double priced_cost(const std::vector<Vec3>& path, const ErrorPrice& price) {
  Drift drift;
  for (std::size_t k = path.size() - 1; k > 0; --k) price.extend(path[k - 1], path[k], drift);
  return price.cost(drift);
}

}  // namespace tern
