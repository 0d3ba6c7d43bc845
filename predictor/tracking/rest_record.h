// How long a stationary track can be trusted to stay, by the record of all stationary tracks.
// Step 9 of docs/prediction.md.
#pragma once

#include <cmath>

namespace tern {

/// The record of all tracks of a flight.
struct RestRecord {
  /// Σ over tracks of the time seen at rest, s. The initial value is a prior without starts.
  double rested_s = 5.0;
  int starts = 0;  ///< tracks that had been at rest and moved
};

/// Returns the time from its last detection within which a stationary track starts with at most this probability, s.
///
/// Starts are a Poisson process with one unknown rate λ for all stationary tracks, a priori uniform. After K starts in
/// E seconds, λ has the density Gamma(K + 1, E). Hence
///   P[a start within s] = 1 − (E/(E + s))^(K+1),
/// which is Laplace's rule of succession in continuous time: s/(E + s) for K = 0. The result is
///   s = E ((1 − P)^(−1/(K+1)) − 1).
/// It grows with the time at rest, and shrinks with the number of starts. @pre 0 < probability < 1
inline double trusted_rest_s(const RestRecord& record, double probability) {
  return record.rested_s * (std::pow(1.0 - probability, -1.0 / (record.starts + 1)) - 1.0);
}

}  // namespace tern
