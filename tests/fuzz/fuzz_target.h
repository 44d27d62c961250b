// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_TESTS_FUZZ_FUZZ_TARGET_H_
#define INVSIM_TESTS_FUZZ_FUZZ_TARGET_H_

// A fuzz target hands bytes that nobody vouches for to one reader. Of any
// bytes must hold:
//
//   - the reader returns, or throws the error of bad input with one printable
//     line; no other exception, no crash, no undefined behaviour;
//   - it asks for memory in proportion to the bytes there are;
//   - what it accepted and our writer writes, it reads back as the same.
//
// Each NAME_fuzz.cpp defines kFuzzTarget. Two programs run it: replay_main.cpp
// (a test: the committed corpus and seeded mutations of it, any compiler) and
// libfuzzer_main.cpp (clang's libFuzzer, led by coverage; `./run fuzz`).

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "invsim/base/error.h"

namespace invsim {

struct FuzzTarget {
  void (*read)(std::string_view bytes);
  // Mends what would hide the reader's inside from mutations, such as a
  // checksum; null if there is nothing of the kind.
  void (*mend)(std::string* bytes) = nullptr;
};

extern const FuzzTarget kFuzzTarget;

// The file name that targets give to readers.
inline const std::string kFuzzName = "input";

// Ends the program, as a finding of the fuzzer.
inline void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

inline bool IsOneLine(std::string_view text) {
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code == 0x7f) return false;
  }
  return true;
}

// What `parse()` returns; nothing if it refuses the input. Any exception but an
// Error of this kind goes on and ends the program. `name` is that of the file,
// or of its folder.
template <typename Parse>
auto ReadOrRefuse(const Parse& parse,
                  ErrorKind kind = ErrorKind::kInput,
                  const std::string& name = kFuzzName)
    -> std::optional<decltype(parse())> {
  try {
    return parse();
  } catch (const Error& error) {
    if (error.kind() != kind) throw;
    const std::string_view what = error.what();
    if (!IsOneLine(what)) std::fprintf(stderr, "%s\n", error.what());
    Require(IsOneLine(what), "an error is one printable line");
    Require(what.substr(0, name.size()) == name,
            "an error begins with the name of the file");
    return std::nullopt;
  }
}

// For what has been accepted once, so that refusing it is a finding.
template <typename Parse>
auto MustRead(const Parse& parse) {
  try {
    return parse();
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    Require(false, "what was accepted and written is accepted again");
    throw;
  }
}

}  // namespace invsim

#endif  // INVSIM_TESTS_FUZZ_FUZZ_TARGET_H_
