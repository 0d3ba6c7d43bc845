#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "monitor/estimate_watch.h"

namespace tern {

std::string to_text(const EstimateMeasures& e) {
  std::string text = fmt::format(
      "  estimate      error {:.2f} m at the end, {:.2f} m at worst, {:.2f} m rms; stated σ {:.2f} m, {:.2f} m\n",
      e.end_m, e.peak_m, e.rmse_m, e.sigma_end_m, e.sigma_peak_m);
  const std::string blind = std::isnan(e.blind_s) ? "" : fmt::format(", {:.1f} s nearly blind", e.blind_s);
  text += fmt::format("                ANEES {:.2f}, inside its 99 % bound {:.1f} % of the time{}\n", e.anees,
                      100.0 * e.coverage, blind);
  return text + fmt::format("  to the goal   {:.2f} m as believed, {:.2f} m in truth\n", e.believed_to_goal_m,
                            e.true_to_goal_m);
}

std::string with_estimate(const std::string& summary_json, const EstimateMeasures& e) {
  auto json = nlohmann::ordered_json::parse(summary_json);
  json["estimate"] = {{"end_m", e.end_m},
                      {"sigma_end_m", e.sigma_end_m},
                      {"peak_m", e.peak_m},
                      {"sigma_peak_m", e.sigma_peak_m},
                      {"rmse_m", e.rmse_m},
                      {"anees", e.anees},
                      {"coverage_99", e.coverage},
                      {"blind_s", e.blind_s},
                      {"corrections", e.corrections},
                      {"believed_to_goal_m", e.believed_to_goal_m},
                      {"true_to_goal_m", e.true_to_goal_m}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tern
