// How long what rests may be trusted to stay: by what was seen of things that rest.
#pragma once

#include <cmath>

namespace tern {

/// Of all tracks together: how long they were seen at rest, and how often one of them started.
struct RestRecord {
  /// A flight begins as if things had rested for so long, all together, without a start.
  double rested_s = 5.0;  ///< Σ over tracks of the time seen at rest, s
  int starts = 0;         ///< tracks that had been at rest and moved
};

/// For how long from its last detection on a thing that rests starts with at most this probability, s.
///
/// Starts are taken for a Poisson process of one unknown rate λ for all things that rest, a priori uniform. After K
/// starts in E seconds λ has the density of Gamma(K + 1, E), so that
///   P[a start within s] = 1 − (E/(E + s))^(K+1)     (Laplace's rule of succession in continuous time: s/(E + s) for K
///   = 0),
/// and the answer is s = E ((1 − P)^(−1/(K+1)) − 1): 0 while nothing is known, longer the longer and the more things
/// rest without a start. @pre 0 < probability < 1.
inline double trusted_rest_s(const RestRecord& record, double probability) {
  return record.rested_s * (std::pow(1.0 - probability, -1.0 / (record.starts + 1)) - 1.0);
}

}  // namespace tern
