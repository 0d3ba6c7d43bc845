// A process for tests: answers each GOAL with one of the next id on GOAL_ANSWER. Goal id 777 ends it with exit code 7;
// its handler throws on 666. `section.period_s` exists so that configuration errors can be made.
#include <stdexcept>

#include "messages/codec.h"
#include "runtime/process.h"

namespace tern {
namespace {

class EchoNode final : public Node {
 public:
  explicit EchoNode(Bus& bus) {
    bus.subscribe(channels::kGoal, [this, &bus](const Goal& goal) {
      if (goal.id == 666) throw std::runtime_error("asked to break");
      if (goal.id == 777) finished_ = 7;
      Goal answer = goal;
      ++answer.id;
      bus.publish(Channel<Goal>{"GOAL_ANSWER"}, answer);
    });
  }
  [[nodiscard]] UTime next_wakeup() const override { return kNever; }
  void step(UTime /*now*/) override {}
  [[nodiscard]] NodeHealth health() const override {
    return {finished_ ? ProcessState::Finished : ProcessState::Ready, ""};
  }
  [[nodiscard]] std::optional<int> finished() const override { return finished_; }

 private:
  std::optional<int> finished_;
};

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  const tern::ProcessDescription description{"tern-echo", "planner", "Answers goals.", {}};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) {
    context.section.number("period_s", 1.0, tern::Range::positive(10.0));
    context.section.finish();
    return std::make_unique<tern::EchoNode>(context.bus);
  });
}
