#pragma once

#include <vector>

namespace posefusion {

struct WanderConfig {
  double amplitude = 1;  ///< standard deviation of the value, in whatever unit it has
  double min_frequency_hz = 0.5;
  double max_frequency_hz = 4;
  int num_waves = 6;
  double burstiness = 0;  ///< 0 = of one strength; 1 = fades in and out over some seconds
};

/// A value that wanders smoothly about zero, as a pure function of time: a sum of sine waves with
/// random frequencies and phases. Waves of higher frequency are weaker, as in the tremor of a hand
/// (amplitude ~ 1/f, so that every wave contributes the same speed).
class Wander {
 public:
  Wander(const WanderConfig& config, int seed, int stream);

  double At(double time_s) const;

 private:
  struct Wave {
    double amplitude;
    double frequency_rad_s;
    double phase_rad;
  };
  std::vector<Wave> waves_;
  double burstiness_;
  Wave envelope_{};
};

}  // namespace posefusion
