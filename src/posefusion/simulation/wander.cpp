#include "posefusion/simulation/wander.h"

#include <cmath>

#include "posefusion/simulation/indexed_random.h"

namespace posefusion {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kMinEnvelopeHz = 0.08;
constexpr double kMaxEnvelopeHz = 0.15;

}  // namespace

Wander::Wander(const WanderConfig& config, int seed, int stream) : burstiness_(config.burstiness) {
  const IndexedRandom random(seed, stream);
  const double range = config.max_frequency_hz / config.min_frequency_hz;
  double power = 0;
  for (int i = 0; i < config.num_waves; ++i) {
    // One wave in each of equal parts of the logarithmic frequency axis.
    const double part = (i + random.Uniform(2 * i)) / config.num_waves;
    const double frequency_hz = config.min_frequency_hz * std::pow(range, part);
    const double amplitude = 1 / frequency_hz;
    power += 0.5 * amplitude * amplitude;
    waves_.push_back({amplitude, kTwoPi * frequency_hz, kTwoPi * random.Uniform(2 * i + 1)});
  }
  for (Wave& wave : waves_) wave.amplitude *= config.amplitude / std::sqrt(power);
  envelope_.frequency_rad_s = kTwoPi * random.Uniform(1000, kMinEnvelopeHz, kMaxEnvelopeHz);
  envelope_.phase_rad = kTwoPi * random.Uniform(1001);
}

double Wander::At(double time_s) const {
  double sum = 0;
  for (const Wave& wave : waves_) {
    sum += wave.amplitude * std::sin(wave.frequency_rad_s * time_s + wave.phase_rad);
  }
  const double strength =
      1 + burstiness_ * std::sin(envelope_.frequency_rad_s * time_s + envelope_.phase_rad);
  return sum * strength;
}

}  // namespace posefusion
