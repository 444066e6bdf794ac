#include "lyrefit/search/learned_setting.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr double kReach = 0.5;  // largest distance of a draw from the remembered value

}  // namespace

double LearnedSetting::Draw(RandomStream* random) {
  const double around = memory_[random->Index(kCells)];
  return std::min(std::max(around + kReach * (2 * random->Uniform() - 1), 0.0), 1.0);
}

void LearnedSetting::Gained(double value, double gain) {
  if (!std::isfinite(gain)) return;
  gain_ += gain;
  weighted_ += gain * value;
}

void LearnedSetting::EndIteration() {
  if (gain_ > 0 && std::isfinite(gain_)) {
    memory_[next_] = weighted_ / gain_;
    next_ = (next_ + 1) % kCells;
  }
  gain_ = weighted_ = 0;
}

}  // namespace lyrefit
