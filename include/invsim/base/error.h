// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_ERROR_H_
#define INVSIM_BASE_ERROR_H_

// Errors that a user can cause. They are thrown where input enters (files,
// options, scene assembly) and caught once, in the command; nothing below an
// evaluation of the fit throws. The text is one line: file, value, expectation.

#include <stdexcept>
#include <string>

namespace invsim {

// The command's exit code follows from the kind (DESIGN: 2, 3, 1).
enum class ErrorKind { kUsage, kInput, kInternal };

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& what)
      : std::runtime_error(what), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// Unusable option or configuration (exit code 2).
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& what)
      : Error(ErrorKind::kUsage, what) {}
};

// Unusable input data (exit code 3).
class InputError : public Error {
 public:
  explicit InputError(const std::string& what)
      : Error(ErrorKind::kInput, what) {}
};

}  // namespace invsim

#endif  // INVSIM_BASE_ERROR_H_
