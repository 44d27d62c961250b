// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_RANDOM_H_
#define INVSIM_BASE_RANDOM_H_

// Random numbers that are the same on every machine for the same seed; the
// standard library's distributions are not. There is no process-wide
// generator: who needs chance is handed a Random, or a seed to make one.
//
// The generator is xoshiro256++ (Blackman and Vigna, "Scrambled linear
// pseudorandom number generators", ACM TOMS 47, 2021), period 2^256 - 1, its
// state filled by splitmix64.

#include <array>
#include <cstdint>

namespace invsim {

class Random {
 public:
  // Every (seed, stream) is its own sequence: give each frame or each scan a
  // stream of its own and the order in which they are drawn does not matter.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  // 64 fair bits.
  std::uint64_t Bits();

  // Uniform in [0, 1), a multiple of 2^-53.
  double Uniform();
  // Uniform in [low, high).
  double Uniform(double low, double high);

  // Uniform in 0 .. n - 1, without bias; n > 0.
  int Index(int n);

  // Normal with mean 0 and variance 1 (Marsaglia's polar method). Equal bits
  // up to the last-digit differences between mathematical libraries' log.
  double Normal();

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

}  // namespace invsim

#endif  // INVSIM_BASE_RANDOM_H_
