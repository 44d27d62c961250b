// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/base64.h"

#include <cstdint>

namespace invsim {

std::string Base64(std::string_view bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 |
              (k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j])
                                    : 0u);
    for (int j = 0; j < 4; ++j)
      text += k + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

}  // namespace invsim
