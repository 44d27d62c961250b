// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/random.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace invsim {
namespace {

// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014:
// a counter of odd step through a mixing function that is one to one.
std::uint64_t SplitMix(std::uint64_t* counter) {
  std::uint64_t z = *counter += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) {
  // Mixing before the stream is added keeps (seed, stream + 1) away from
  // (seed + 1, stream).
  std::uint64_t counter = seed;
  counter = SplitMix(&counter) + stream;
  counter = SplitMix(&counter);
  for (std::uint64_t& word : state_) word = SplitMix(&counter);
}

std::uint64_t Random::Bits() {
  auto& s = state_;
  const std::uint64_t result = std::rotl(s[0] + s[3], 23) + s[0];
  const std::uint64_t shifted = s[1] << 17;
  s[2] ^= s[0];
  s[3] ^= s[1];
  s[1] ^= s[2];
  s[0] ^= s[3];
  s[2] ^= shifted;
  s[3] = std::rotl(s[3], 45);
  return result;
}

double Random::Uniform() {
  return static_cast<double>(Bits() >> 11) * 0x1.0p-53;
}

double Random::Uniform(double low, double high) {
  return low + (high - low) * Uniform();
}

int Random::Index(int n) {
  assert(n > 0);
  // Throw away the incomplete last round of remainders.
  const std::uint64_t range = static_cast<std::uint64_t>(n);
  const std::uint64_t incomplete = (0 - range) % range;
  std::uint64_t bits = Bits();
  while (bits < incomplete) bits = Bits();
  return static_cast<int>(bits % range);
}

double Random::Normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  double u, v, s;
  do {
    u = 2 * Uniform() - 1;
    v = 2 * Uniform() - 1;
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  const double scale = std::sqrt(-2 * std::log(s) / s);
  spare_normal_ = scale * v;
  has_spare_ = true;
  return scale * u;
}

}  // namespace invsim
