// Whether each request was answered once, in time by the planner's own stamp, and from a fresh world.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "tools/audit/audit.h"
#include "tools/audit/configured.h"

namespace tern::audit {
namespace {

constexpr double kDefaultStaleAfter = 0.3;  // s

double stale_after_of(const std::string& setting) {
  return setting.empty() ? kDefaultStaleAfter : std::strtod(setting.c_str(), nullptr);
}

/// Returns true if the answers around `when` come from two planners, because one ended and another started.
bool planner_changed(const FlightRecord& record, UTime when) {
  const Plan* before = nullptr;
  for (const Plan& plan : record.plans) {
    if (plan.header.utime >= when) {
      return before == nullptr || before->header.name.sender_epoch_us != plan.header.name.sender_epoch_us;
    }
    before = &plan;
  }
  return false;
}

class AnswerCheck {
 public:
  AnswerCheck(const FlightRecord& record, Check& check)
      : record_(record), check_(check), stale_after_(stale_after_of(planner_setting(record, "stale_after_s"))) {}

  void plan(const Plan& plan) {
    const HorizonRequest* found = record_.request(plan.inputs.request);
    if (found == nullptr) {
      ++check_.unchecked["plans whose request is not in the log"];
      return;
    }
    const HorizonRequest& request = *found;
    ++check_.checked;
    const auto [first, is_first] = answers_.try_emplace(request.header.name, plan.header.name.sender_epoch_us);
    if (!is_first) return again(plan, first->second);
    const double late_s = (plan.header.utime - request.deadline).seconds();
    least_spare_s_ = std::min(least_spare_s_, -late_s);
    if (late_s > 0.0) fail(plan, fmt::format("answered {:.3f} ms after its deadline", late_s * 1e3));
    if (plan.outcome != PlanOutcome::NoPlan) fresh(plan, request);
  }

  /// A planner answers once. Two planners may both answer; the executor takes the first answer.
  void again(const Plan& plan, std::int64_t first_planner) {
    if (plan.header.name.sender_epoch_us == first_planner) return fail(plan, "answered more than once");
    ++second_answers_;
  }

  void fresh(const Plan& plan, const HorizonRequest& request) {
    const auto set = record_.predictions.find(plan.inputs.predictions);
    if (set == record_.predictions.end()) {
      ++check_.unchecked["plans whose predictions are not in the log"];
      return;
    }
    ++check_.checked;
    if (set->second.batch.set != plan.inputs.prediction_set) fail(plan, "names predictions of another set");
    if (set->second.left_out != plan.inputs.left_out)
      fail(plan, "its number of left-out tracks differs from that of its predictions");
    if (plan.inputs.left_out > 0) ++check_.unchecked["plans from predictions that left tracks out"];
    const double age_s = (request.header.utime - set->second.made_at).seconds();
    oldest_s_ = std::max(oldest_s_, age_s);
    if (age_s > stale_after_)
      fail(plan, fmt::format("planned on predictions {:.3f} s old, limit {:.3f} s", age_s, stale_after_));
  }

  /// An executor that rejoins replaces its request at once.
  [[nodiscard]] bool was_replaced(const HorizonRequest& request) const {
    return std::any_of(record_.requests.begin(), record_.requests.end(), [&](const HorizonRequest& r) {
      const bool same_sender = r.header.name.sender_epoch_us == request.header.name.sender_epoch_us;
      return same_sender && r.id > request.id && r.header.utime < request.deadline;
    });
  }

  /// Of messages that a silence of the log swallowed, no later number may tell.
  [[nodiscard]] bool in_silence(const HorizonRequest& request) const {
    const auto& spans = record_.contents.spans;
    for (std::size_t k = 1; k < spans.size(); ++k) {
      if (request.deadline.us > spans[k - 1].second && request.header.utime.us < spans[k].first) return true;
    }
    return false;
  }

  void unanswered() {
    std::int64_t unread = record_.unread(channels::kPlan.name);
    for (const HorizonRequest& r : record_.requests) {
      if (answers_.contains(r.header.name)) continue;
      if (r.deadline >= record_.end()) {
        ++check_.unchecked["requests that were open when the log ended"];
      } else if (in_silence(r)) {
        ++check_.unchecked["requests whose answer falls into a silence of the log"];
      } else if (unread > 0) {
        --unread;
        ++check_.unchecked["requests whose answer may be among the PLANs that were lost or refused"];
      } else if (was_replaced(r)) {
        ++check_.unchecked["requests that were replaced before their deadline"];
      } else if (planner_changed(record_, r.header.utime)) {
        ++check_.unchecked["requests while no planner was running"];
      } else {
        ++check_.checked;
        check_.fail({r.deadline, "was never answered", r.id});
      }
    }
  }

  void summarize() {
    if (check_.checked == 0) return;
    check_.summary =
        fmt::format("{} answers to {} requests, at least {:.1f} ms to spare; predictions at most {:.0f} ms old{}",
                    answers_.size(), record_.requests.size(), least_spare_s_ * 1e3, oldest_s_ * 1e3,
                    second_answers_ > 0 ? fmt::format("; {} second answers by another planner", second_answers_) : "");
    check_.measures = {{"least_spare_s", least_spare_s_},
                       {"oldest_predictions_s", oldest_s_},
                       {"second_answers", static_cast<double>(second_answers_)}};
  }

 private:
  void fail(const Plan& plan, std::string what) { check_.fail({plan.header.utime, std::move(what), plan.request_id}); }

  const FlightRecord& record_;
  Check& check_;
  double stale_after_;
  std::map<MessageName, std::int64_t> answers_;  ///< first planner that answered, by request
  std::int64_t second_answers_ = 0;
  double least_spare_s_ = 1e9, oldest_s_ = 0.0;
};

}  // namespace

Check check_answers(const FlightRecord& record) {
  Check check{.name = "answers", .claim = "each request was answered once, by its deadline, from a fresh world"};
  AnswerCheck answers(record, check);
  for (const Plan& plan : record.plans) answers.plan(plan);
  answers.unanswered();
  answers.summarize();
  return check;
}

}  // namespace tern::audit
