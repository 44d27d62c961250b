// SPDX-License-Identifier: Apache-2.0
#include "mend_records.h"

#include <cstdint>
#include <cstring>

#include "invsim/base/digest.h"

namespace invsim {
namespace {

constexpr char kMagic[] = "invsimf1";

std::uint64_t Checksum(const char* from, std::uint64_t doubles) {
  Digest digest;
  for (std::uint64_t k = 0; k < doubles; ++k) {
    double value;
    std::memcpy(&value, from + k * sizeof(value), sizeof(value));
    digest.Add(value);
  }
  return digest.value();
}

}  // namespace

void MendRecords(std::string* bytes) {
  if (!bytes->starts_with(kMagic)) return;
  std::uint64_t header[2];  // doubles, checksum
  for (size_t at = sizeof(kMagic) - 1; at + sizeof(header) <= bytes->size();) {
    std::memcpy(header, bytes->data() + at, sizeof(header));
    const size_t room = (bytes->size() - at - sizeof(header)) / sizeof(double);
    if (header[0] > room) return;
    header[1] = Checksum(bytes->data() + at + sizeof(header), header[0]);
    std::memcpy(bytes->data() + at, header, sizeof(header));
    at += sizeof(header) + header[0] * sizeof(double);
  }
}

}  // namespace invsim
