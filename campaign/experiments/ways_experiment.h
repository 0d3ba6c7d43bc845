// Which way the planner chooses in drawn worlds of textures, some of whose labels are wrong, and what that costs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/experiments/mean_interval.h"

namespace tern {

enum class WaysFamily : std::uint8_t {
  Lake,     ///< water on the straight way
  Hall,     ///< a dark hall with textured walls
  Facade,   ///< a façade beside plain ground
  River,    ///< a river across the way, with a bridge
  Patches,  ///< patches of texture and water
};
inline constexpr int kWaysFamilies = 5;
const char* to_string(WaysFamily family);

/// By what a way is chosen.
enum class WayChooser : std::uint8_t {
  Shortest,    ///< semantics off
  Exposure2,   ///< exposure with λ = 2, the default
  Exposure03,  ///< exposure with λ = 0.3
  Price,       ///< the price of the error, by the labels of the map
  Oracle,      ///< the price of the error, by the true labels
};
inline constexpr int kWayChoosers = 5;
const char* to_string(WayChooser chooser);

struct WaysOptions {
  int worlds = 100;          ///< the families in turn
  std::uint64_t seed = 1;    ///< of the first world
  double price = 20.0;       ///< metres of way per metre of σ
  double wrong_share = 0.2;  ///< probability that the label of a region is wrong: water for texture and vice versa
};

/// One way: the path to the goal by one chooser, judged by Belief15 among the densities of the true labels.
struct ChosenWay {
  int world = 0;
  WaysFamily family = WaysFamily::Lake;
  int regions = 0, wrong_labels = 0;
  WayChooser chooser = WayChooser::Shortest;
  double way_m = 0.0, sigma_goal_m = 0.0, sigma_worst_m = 0.0;
  double cost_m = 0.0;  ///< J = way + price · (σ_goal + σ_worst), m
};

/// Returns the ways of all choosers through each world. Deterministic. About 1.5 s per world.
std::vector<ChosenWay> choose_ways(const WaysOptions& options);

/// Returns J over that of the oracle in the same world, less one, over all worlds of the family (all if < 0).
MeanInterval regret(const std::vector<ChosenWay>& ways, WayChooser chooser, int family = -1);

std::string to_csv(const std::vector<ChosenWay>& ways);
/// Returns a table in Markdown: mean regret with its 95 % interval, per chooser and family.
std::string to_markdown(const std::vector<ChosenWay>& ways);

}  // namespace tern
