// SPDX-License-Identifier: Apache-2.0
#include "toml_letters.h"

#include <cstdint>

namespace invsim {
namespace {

bool IsBeyondAscii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

// Whether bytes beyond ASCII are whole, shortest sequences of UTF-8.
bool IsUtf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int tail = lead < 0x80 ? 0 : lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
    std::uint32_t code = tail == 0 ? lead : lead & (0x3f >> tail);
    if (lead >= 0x80 && (lead < 0xc0 || lead > 0xf4)) return false;
    if (i + tail >= text.size()) return false;
    for (int k = 1; k <= tail; ++k) {
      if ((text[i + k] & 0xc0) != 0x80) return false;
      code = code << 6 | (text[i + k] & 0x3f);
    }
    constexpr std::uint32_t kSmallest[] = {0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    if (code < kSmallest[tail] || code > 0x10ffff || is_surrogate) return false;
    i += 1 + tail;
  }
  return true;
}

}  // namespace

std::string Encoded(std::string_view toml) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string text;
  for (const char c : toml) {
    if (c == '%' || IsBeyondAscii(c)) {
      text += {'%', kHex[(c >> 4) & 15], kHex[c & 15]};
    } else {
      text += c;
    }
  }
  return text;
}

std::string Decoded(std::string_view text) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'A' + 10; };
  std::string toml;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      toml += static_cast<char>(digit(text[i + 1]) << 4 | digit(text[i + 2]));
      i += 2;
    } else {
      toml += text[i];
    }
  }
  return toml;
}

// The escapes would come out as the '%' of a code.
std::string LetterComplaint(std::string_view toml) {
  if (!IsUtf8(toml)) return "expected text in UTF-8";
  for (const std::string_view escape : {"\\u0025", "\\U00000025"})
    if (toml.find(escape) != std::string_view::npos)
      return std::string(escape) + ": expected the letter % itself";
  return "";
}

}  // namespace invsim
