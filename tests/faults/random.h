#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace faults {

// Combines a seed and the indices of a draw into one seed, by splitmix64 over each.
inline std::uint64_t SeedOf(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0,
                            std::uint64_t c = 0) {
  for (const std::uint64_t part : {a, b, c}) {
    seed += 0x9e3779b97f4a7c15u + part * 0xd1342543de82ef95u;
    seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9u;
    seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebu;
    seed ^= seed >> 31;
  }
  return seed;
}

// Random numbers that do not depend on the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double Unit() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Unit(); }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  int Index(int count) { return static_cast<int>(Unit() * count); }
  bool Chance(double probability) { return Unit() < probability; }
  double Sign() { return Chance(0.5) ? 1 : -1; }
  double Normal() {  // Box-Muller
    const double radius = std::sqrt(-2 * std::log(Unit()));
    return radius * std::cos(6.283185307179586 * Unit());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace faults
