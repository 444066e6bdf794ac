// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A portable stream of random numbers for each pair (seed, run): xoshiro256++ (Blackman and Vigna
// 2021, doi:10.1145/3460772). Bits, Uniform and Index use integers and basic arithmetic only. A
// seed therefore gives their numbers with every compiler and standard library. std::mt19937_64 is
// as portable but six times slower; it took a fifth of a whole search.
class RandomStream {
 public:
  // The stream is fixed by seed and run; other pairs give other streams.
  explicit RandomStream(std::uint64_t seed, std::uint64_t run = 0);

  // 64 random bits.
  std::uint64_t Bits() {
    const std::uint64_t result = Rotate(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = Rotate(state_[3], 45);
    return result;
  }

  // Uniform in [0, 1), 53 bits.
  double Uniform() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }

  // Uniform in {0, ..., n - 1}, from the high half of a 64 x 32 bit product; n >= 1. The bias of at
  // most n / 2^32 is far below what a run of this library can resolve.
  std::uint32_t Index(std::uint32_t n) {
    return static_cast<std::uint32_t>(((Bits() >> 32) * n) >> 32);
  }

  // Standard normal deviate (Marsaglia's polar method).
  double Normal();

 private:
  static std::uint64_t Rotate(std::uint64_t x, int bits) {
    return (x << bits) | (x >> (64 - bits));
  }

  std::uint64_t state_[4];
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace lyrefit
