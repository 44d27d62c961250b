// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_DIGEST_H_
#define INVSIM_BASE_DIGEST_H_

// A number of 64 bits that stands for data: other data of the same types have
// another one but by a chance of 2^-64, unless somebody looked for them (it is
// FNV-1a by words, no cryptography). Types are not told apart: 0.0, 0 and an
// empty text are alike.

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace invsim {

class Digest {
 public:
  // Doubles bit by bit: 0 and -0 differ.
  void Add(double value);
  void Add(std::int64_t value);
  void Add(int value) { Add(static_cast<std::int64_t>(value)); }
  // With their length, so that what follows is told apart.
  void Add(std::string_view text);
  void Add(std::span<const double> values);
  void Add(std::span<const int> values);
  // With its size, coefficients column by column.
  template <typename Derived>
  void Add(const Eigen::DenseBase<Derived>& matrix) {
    Add(static_cast<std::int64_t>(matrix.rows()));
    Add(static_cast<std::int64_t>(matrix.cols()));
    for (Eigen::Index c = 0; c < matrix.cols(); ++c)
      for (Eigen::Index r = 0; r < matrix.rows(); ++r)
        Add(matrix.derived().coeff(r, c));
  }

  std::uint64_t value() const { return value_; }
  std::string text() const;  // 16 hexadecimal digits

 private:
  void AddBits(std::uint64_t bits);

  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace invsim

#endif  // INVSIM_BASE_DIGEST_H_
