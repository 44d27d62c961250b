// SPDX-License-Identifier: Apache-2.0
#include "mutate.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace invsim {
namespace {

constexpr int kLongestPiece = 64;

// A place in `bytes`, or its end.
std::size_t Place(const std::string& bytes, Random* random) {
  return random->Index(static_cast<int>(bytes.size()) + 1);
}

std::string Piece(const std::string& bytes, Random* random) {
  const std::size_t at = Place(bytes, random);
  return bytes.substr(at, 1 + random->Index(kLongestPiece));
}

// The place and the length of a number written in digits; length 0: none.
std::pair<std::size_t, std::size_t> FindDigits(const std::string& bytes,
                                               Random* random) {
  constexpr char kDigits[] = "0123456789";
  const std::size_t from = Place(bytes, random);
  const std::size_t begin = bytes.find_first_of(kDigits, from);
  if (begin == std::string::npos) return {from, 0};
  const std::size_t end = bytes.find_first_not_of(kDigits, begin);
  return {begin, std::min(end, bytes.size()) - begin};
}

std::string HostileNumber(Random* random) {
  static const std::vector<std::string> numbers = {"0",
                                                   "-1",
                                                   "1",
                                                   "2",
                                                   "255",
                                                   "65536",
                                                   "2147483647",
                                                   "2147483648",
                                                   "-2147483648",
                                                   "4294967295",
                                                   "1000000000000",
                                                   "9223372036854775807",
                                                   "-9223372036854775808",
                                                   "18446744073709551616",
                                                   "1e999",
                                                   "-1e-999",
                                                   "1e39",
                                                   "nan",
                                                   "inf",
                                                   "0x10",
                                                   "1.5",
                                                   "",
                                                   "+",
                                                   "1_000"};
  return numbers[random->Index(static_cast<int>(numbers.size()))];
}

// One, two, four or eight bytes of a count at the edge of its range.
std::string HostileCount(Random* random) {
  constexpr std::uint64_t kEdges[] = {
      0,
      1,
      0x7f,
      0xff,
      0x7fff,
      0xffff,
      0x7fffffff,
      0xffffffff,
      1u << 30,
      std::numeric_limits<std::int64_t>::max(),
      std::numeric_limits<std::uint64_t>::max()};
  const std::uint64_t value =
      kEdges[random->Index(std::size(kEdges))] + random->Index(3) - 1;
  const int size = 1 << random->Index(4);
  std::string bytes;
  for (int i = 0; i < size; ++i) {
    bytes += static_cast<char>(value >> (8 * i) & 0xff);
  }
  if (random->Index(2) == 0) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

void Overwrite(const std::string& with, Random* random, std::string* bytes) {
  const std::size_t at = Place(*bytes, random);
  bytes->replace(at, with.size(), with);
}

void ChangeOnce(const std::vector<std::string>& corpus,
                Random* random,
                std::string* bytes) {
  switch (random->Index(10)) {
    case 0: {
      if (bytes->empty()) return;
      char& c = (*bytes)[random->Index(static_cast<int>(bytes->size()))];
      c = static_cast<char>(c ^ (1 << random->Index(8)));
      return;
    }
    case 1:
      return Overwrite({static_cast<char>(random->Index(256))}, random, bytes);
    case 2:
    case 3:
      return Overwrite(HostileCount(random), random, bytes);
    case 4:
    case 5: {
      const auto [at, size] = FindDigits(*bytes, random);
      bytes->replace(at, size, HostileNumber(random));
      return;
    }
    case 6:
      bytes->erase(Place(*bytes, random), 1 + random->Index(kLongestPiece));
      return;
    case 7:
      bytes->insert(Place(*bytes, random), Piece(*bytes, random));
      return;
    case 8: {
      const int other = random->Index(static_cast<int>(corpus.size()));
      bytes->insert(Place(*bytes, random), Piece(corpus[other], random));
      return;
    }
    default:
      bytes->resize(Place(*bytes, random));
  }
}

}  // namespace

std::string Mutate(const std::vector<std::string>& corpus, Random* random) {
  std::string bytes = corpus[random->Index(static_cast<int>(corpus.size()))];
  const int changes = 1 + random->Index(4);
  for (int i = 0; i < changes; ++i) ChangeOnce(corpus, random, &bytes);
  return bytes;
}

}  // namespace invsim
