// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_SRC_BASE_TOML_LETTERS_H_
#define INVSIM_SRC_BASE_TOML_LETTERS_H_

// toml++ 3.3 runs into undefined behaviour where it asks of some letters
// beyond ASCII whether they are blanks. It is given none: their bytes, and '%'
// itself, go in as %XX and come out of keys and texts as they were.

#include <string>
#include <string_view>

namespace invsim {

std::string Encoded(std::string_view toml);
std::string Decoded(std::string_view text);

// Why a file cannot be given to toml++ so; empty if it can: it is no UTF-8 (the
// parser no longer sees that), or writes '%' as an escape.
std::string LetterComplaint(std::string_view toml);

}  // namespace invsim

#endif  // INVSIM_SRC_BASE_TOML_LETTERS_H_
