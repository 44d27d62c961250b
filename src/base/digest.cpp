// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/digest.h"

#include <bit>
#include <cstdio>

namespace invsim {

void Digest::AddBits(std::uint64_t bits) {
  value_ = (value_ ^ bits) * 1099511628211u;
  value_ ^= value_ >> 29;  // high bits reach low ones, too
}

void Digest::Add(double value) { AddBits(std::bit_cast<std::uint64_t>(value)); }

void Digest::Add(std::int64_t value) {
  AddBits(static_cast<std::uint64_t>(value));
}

void Digest::Add(std::string_view text) {
  Add(static_cast<std::int64_t>(text.size()));
  for (const char c : text) AddBits(static_cast<unsigned char>(c));
}

void Digest::Add(std::span<const double> values) {
  Add(static_cast<std::int64_t>(values.size()));
  for (const double value : values) Add(value);
}

void Digest::Add(std::span<const int> values) {
  Add(static_cast<std::int64_t>(values.size()));
  for (const int value : values) Add(value);
}

std::string Digest::text() const {
  char digits[17];
  std::snprintf(digits,
                sizeof(digits),
                "%016llx",
                static_cast<unsigned long long>(value_));
  return digits;
}

}  // namespace invsim
