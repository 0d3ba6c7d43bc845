#include "tools/replay/recorded_problems.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace tern {

Result<LogContents> visit_answers(const std::string& path, const RecordedInputs& inputs, const ReplayOptions& options,
                                  const UseAnswer& use) {
  using SetName = std::pair<std::int64_t, std::int64_t>;  // sender epoch, set
  WorldRebuilder world(inputs, options.other);
  std::map<SetName, std::vector<std::size_t>> waiting;  // answers by the set that they name
  for (std::size_t k = 0; k < inputs.plans.size(); ++k) {
    if (!is_chosen(inputs.plans[k], inputs.log, options)) continue;
    const PlanInputs& names = inputs.plans[k].plan.inputs;
    waiting[{names.predictions.sender_epoch_us, names.prediction_set}].push_back(k);
  }
  const auto visit_those_of = [&](const SetName& name) {
    auto answers = waiting.extract(name);
    if (answers.empty()) return;
    for (const std::size_t k : answers.mapped()) use(k, world);
  };
  visit_those_of({0, 0});  // answers STALE_WORLD name no predictions
  auto contents = read_prediction_sets(path, options.suffix, [&](TrackSet set) {
    const SetName name{set.header.name.sender_epoch_us, set.batch.set};
    world.add(std::move(set));
    visit_those_of(name);
  });
  if (!contents) return contents;
  while (!waiting.empty()) visit_those_of(SetName(waiting.begin()->first));
  return contents;
}

}  // namespace tern
