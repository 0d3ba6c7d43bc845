// A node for tests: publishes a goal at a fixed period, receives goals, and may finish.
#pragma once

#include <string>
#include <vector>

#include "messages/codec.h"
#include "runtime/bus.h"
#include "runtime/node.h"

namespace tern {

/// Publishes a Goal with id 1, 2, … every `period` (first at the start), records its messages and steps in a shared
/// journal.
class Talker final : public Node {
 public:
  struct Options {
    std::string name;
    Duration period{0};             ///< 0: only receives
    std::int64_t finish_after = 0;  ///< goals published before it finishes with exit code 7; 0: never
  };

  Talker(Bus& bus, Options options, std::vector<std::string>* journal)
      : bus_(bus),
        options_(std::move(options)),
        journal_(journal),
        next_(options_.period.us > 0 ? bus.clock().now() : kNever) {
    bus_.subscribe(channels::kGoal, [this](const Goal& goal) {
      ++heard_;
      write("hears " + std::to_string(goal.id) + " of " + std::to_string(goal.header.name.sender_epoch_us));
    });
  }

  [[nodiscard]] UTime next_wakeup() const override { return next_; }

  void step(UTime now) override {
    ++steps_;
    if (next_ > now) return;
    next_ = now + options_.period;
    Goal goal;
    goal.id = ++said_;
    bus_.publish(channels::kGoal, goal);
    write("says " + std::to_string(said_));
  }

  [[nodiscard]] NodeHealth health() const override {
    return {finished() ? ProcessState::Finished : ProcessState::Ready, ""};
  }

  [[nodiscard]] std::optional<int> finished() const override {
    if (options_.finish_after > 0 && said_ >= options_.finish_after) return 7;
    return std::nullopt;
  }

  [[nodiscard]] std::int64_t heard() const { return heard_; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }

 private:
  void write(const std::string& what) {
    if (journal_ != nullptr)
      journal_->push_back(std::to_string(bus_.clock().now().us) + " " + options_.name + " " + what);
  }

  Bus& bus_;
  Options options_;
  std::vector<std::string>* journal_;
  UTime next_;
  std::int64_t said_ = 0;
  std::int64_t heard_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace tern
