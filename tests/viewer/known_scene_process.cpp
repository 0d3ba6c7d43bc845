// known_scene_process: publishes the known scene, for the browser tests. With KNOWN_LOG=FILE it writes the scene to
// that log instead; KNOWN_LEAD_S, KNOWN_COURSE and KNOWN_SIGHTED_S are options of write_known_log. It prints each
// received goal.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "messages/codec.h"
#include "runtime/process.h"
#include "tests/viewer/known_log.h"
#include "tests/viewer/known_scene.h"

namespace tern {
namespace {

class KnownSceneNode final : public Node {
 public:
  explicit KnownSceneNode(Bus& bus) : bus_(bus), scene_(bus.clock().now()), next_(bus.clock().now()) {
    bus.subscribe(channels::kGoal, [](const Goal& goal) {
      std::printf("goal %lld %.3f %.3f %.3f\n", static_cast<long long>(goal.id), goal.position.x(), goal.position.y(),
                  goal.position.z());
      std::fflush(stdout);
    });
  }
  [[nodiscard]] UTime next_wakeup() const override { return next_; }
  [[nodiscard]] NodeHealth health() const override { return {ProcessState::Ready, ""}; }
  void step(UTime now) override {
    if (now < next_) return;
    next_ = now + Duration{10'000};
    bus_.publish(channels::kUavState, scene_.state(now));
    if (tick_ % 5 == 0) {
      bus_.publish(channels::kObstacleTruth, scene_.truth(now));
      bus_.publish(channels::kPredictions, scene_.predictions(now));
      const HorizonRequest request = scene_.request(now, ++requests_);
      bus_.publish(channels::kHorizonRequest, request);
      bus_.publish(channels::kPlan, scene_.plan(request));
      bus_.publish(channels::kSearchView, scene_.search(request.id));
      bus_.publish(channels::kPlanTiming, scene_.timing(request.id));
    }
    if (tick_ % 50 == 0) {
      for (const MapChunk& chunk : to_chunks(scene_.map())) bus_.publish(channels::kSemanticMap, chunk);
    }
    if (tick_ % 100 == 0) bus_.publish(channels::kGoal, scene_.goal());
    ++tick_;
  }

 private:
  Bus& bus_;
  support::KnownScene scene_;
  UTime next_;
  std::int64_t tick_ = 0, requests_ = 0;
};

}  // namespace
}  // namespace tern

int main(int argc, char** argv) {
  if (const char* log = std::getenv("KNOWN_LOG")) {
    const auto number = [](const char* name) {
      const char* text = std::getenv(name);
      return text == nullptr ? 0.0 : std::atof(text);
    };
    const auto seconds = [&](const char* name) { return tern::Duration::from_seconds(number(name)); };
    tern::support::write_known_log(log, seconds("KNOWN_LEAD_S"), number("KNOWN_COURSE"), seconds("KNOWN_SIGHTED_S"));
    return 0;
  }
  const tern::ProcessDescription description{.name = "tern-scene", .section = "", .summary = "A known scene"};
  return tern::run_process(argc, argv, description, [](tern::ProcessContext& context) -> std::unique_ptr<tern::Node> {
    return std::make_unique<tern::KnownSceneNode>(context.bus);
  });
}
