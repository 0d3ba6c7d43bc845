#include "planner/heading/texture_term.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "planner/problem/tuning.h"
#include "planner/semantics/drift.h"

namespace tern {

void TextureTerm::look(const LookInstant& now, std::vector<LookTarget>& targets) const {
  constexpr int kHeadings = InformationMap::kRays;
  const double most = dark_growth(kTextureDark);
  std::array<double, kHeadings> growth;
  double told = 0.0;
  for (int k = 0; k < kHeadings; ++k) {
    growth[idx(k)] = std::min(most, static_cast<double>(information_.sight(now.p, k).growth));
    told += 1.0 / growth[idx(k)];
  }
  const auto [least, largest] = std::minmax_element(growth.begin(), growth.end());
  const double worth = (*largest - *least) / (2.0 * kTextureSigma);
  for (int k = 0; k < kHeadings; ++k) {
    targets.push_back(
        {2.0 * std::numbers::pi * k / kHeadings, worth / (growth[idx(k)] * told), 0.5 * information_.view_rad()});
  }
}

}  // namespace tern
