// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_TEXT_FORMAT_H_
#define INVSIM_IO_TEXT_FORMAT_H_

#include <charconv>
#include <string>

namespace invsim {

// Appends `separator` and the shortest digits that read back as `value`.
template <typename Number>
void AppendNumber(char separator, Number value, std::string* text) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
  text->push_back(separator);
  text->append(digits, end);
}

}  // namespace invsim

#endif  // INVSIM_IO_TEXT_FORMAT_H_
