// Texture: the landmarks on which the vehicle's estimate of its position rests.
#pragma once

#include "planner/heading/look_term.h"
#include "planner/semantics/information_map.h"

namespace tern {

/// Looks where the camera of the estimator sees most, as labels promise it.
///
/// Let q(ψ) be the growth of the position's variance with heading ψ, m²/s (InformationMap), at most that after
/// kTextureDark of darkness. The term's unit is m of σ. Not looking at the best heading costs
///
///     (max q − min q) / (2 kTextureSigma)   per second,
///
/// shared among the headings in proportion to 1/q, so that the view turns to the middle of what is worth seeing. The
/// field of view is that of TextureCamera: `uav.heading.view` is that of the sensors of obstacles.
class TextureTerm final : public LookTerm {
 public:
  /// @param information  is kept by reference  @param error_price  m/m, > 0
  TextureTerm(const InformationMap& information, double error_price)
      : information_(information), error_price_(error_price) {}

  [[nodiscard]] double weight() const override { return error_price_; }
  void look(const LookInstant& now, std::vector<LookTarget>& targets) const override;

 private:
  const InformationMap& information_;
  double error_price_;
};

}  // namespace tern
