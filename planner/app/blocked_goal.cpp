#include "planner/app/blocked_goal.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/geometry/box.h"
#include "core/world/body.h"
#include "planner/tuning.h"

namespace tern {

std::string blocked_in_words(const GoalField& field, const GoalFieldKey& key, const std::vector<Box>& static_boxes,
                             const Vec3& start) {
  if (!places_within(key.flight_box, key.body).contains(key.goal)) return "it is not within the flight box";
  const auto blocker = field.blocker(start);
  if (!blocker) return "no way within the flight box leads there";
  const Vec3 spacing = Vec3::Constant(kPathSpacing);
  const Box box(blocker->min() + key.body.max() + spacing, blocker->max() + key.body.min() - spacing);
  const bool is_static = std::any_of(static_boxes.begin(), static_boxes.end(), [&](const Box& b) {
    const Vec3 apart = (b.min() - box.min()).cwiseAbs().cwiseMax((b.max() - box.max()).cwiseAbs());
    return apart.maxCoeff() <= kPathSpacing;  // what holds goal or start counts a little less
  });
  const auto place = [](const Vec3& p) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x(), p.y(), p.z()); };
  return fmt::format("{} from {} to {} {}", is_static ? "an obstacle" : "what the map says is occupied",
                     place(box.min()), place(box.max()),
                     blocker->contains(key.goal) ? "leaves no room there" : "is the first in the way");
}

}  // namespace tern
