// What the models' filters say of the future: mean and deviation over the horizon.
#pragma once

#include <vector>

#include "predictor/models/axis_filter.h"
#include "predictor/models/promise.h"
#include "predictor/models/singer_filter.h"

namespace tern {

/// ∫ √(det P(t))/P_xx(t) dt over [0, horizon_s], by Simpson's rule on t = horizon·u³ (the integrand falls like 1/t).
double crossing_integral(const AxisFilter& filter, double q, double horizon_s);

AxisForecast forecast(const AxisFilter& filter, double q, const PredictionSpec& spec);

/// What a start adds to the covariance of position and velocity, per axis, at the times of piece_ends and at those of
/// the crossing integral. One serves all that may start at the same time.
struct StartSpread {
  struct Added {
    double xx = 0.0, xv = 0.0, vv = 0.0;  ///< m², m²/s, m²/s²
  };
  std::vector<Added> ends, nodes;
};

/// Of what rests until `still_s` from now (before now, if negative) and then goes as the model says that things go:
/// where accelerations last, from an acceleration of their stationary variance; where velocities do (constant
/// velocity), at once with any of them, as what is seen for the first time. Who starts later is nearer to where it
/// rested.
StartSpread start_spread(double still_s, const AccelerationModel& model, const PredictionSpec& spec);

/// Of what rests: the filter's covariance grows by q, and by the spread of its start.
AxisForecast forecast_of_rest(const AxisFilter& filter, double q, const StartSpread& start, const PredictionSpec& spec);

/// The transitions that forecasts of one model need, made once for all tracks.
class SingerForecaster {
 public:
  SingerForecaster(const AccelerationModel& model, const PredictionSpec& spec);
  [[nodiscard]] AxisForecast forecast(const SingerFilter& filter) const;

 private:
  struct Node {
    Transition step;  ///< from the start
    double weight;    ///< of Simpson's rule, s
  };
  std::vector<Transition> ends_;
  std::vector<Node> nodes_;
};

}  // namespace tern
