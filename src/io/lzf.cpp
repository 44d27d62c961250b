// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/lzf.h"

namespace invsim {

std::optional<std::string> UnpackLzf(std::string_view packed,
                                     std::size_t size) {
  if (size / 264 > packed.size()) return std::nullopt;
  std::string out;
  out.reserve(size);
  std::size_t at = 0;
  // The next byte; `ok` is false once there was none.
  bool ok = true;
  const auto next = [&]() -> std::size_t {
    if (at < packed.size()) return static_cast<unsigned char>(packed[at++]);
    ok = false;
    return 0;
  };
  while (at < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - at) return std::nullopt;
      out.append(packed.substr(at, length));
      at += length;
    } else {
      std::size_t length = (control >> 5) + 2;
      if (length == 9) length += next();
      const std::size_t distance = ((control & 31) << 8) + next() + 1;
      if (!ok || distance > out.size()) return std::nullopt;
      // Byte by byte: a run may overlap what it writes.
      for (std::size_t i = 0; i < length; ++i) {
        out.push_back(out[out.size() - distance]);
      }
    }
    if (out.size() > size) return std::nullopt;
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace invsim
