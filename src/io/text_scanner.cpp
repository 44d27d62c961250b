// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/text_scanner.h"

#include <charconv>
#include <cmath>

#include "invsim/base/error.h"

namespace invsim {
namespace {

// Every control character counts as a blank, so that no word can break the
// one line of a message.
bool IsBlank(char c) {
  return static_cast<unsigned char>(c) <= ' ' && c != '\n' && c != '\r';
}

bool IsLineEnd(char c) { return c == '\n' || c == '\r'; }

std::size_t LineEndSize(std::string_view bytes, std::size_t at) {
  return bytes.substr(at, 2) == "\r\n" ? 2 : 1;
}

// from_chars knows no leading '+', which some exporters write.
std::string_view WithoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  return word;
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string printable(text);
  for (char& c : printable) {
    if (c < ' ' || c > '~') c = '?';
  }
  return printable;
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  return "'" + Printable(word.substr(0, kLongest)) +
         (word.size() > kLongest ? "...'" : "'");
}

bool TextScanner::AtLineEnd() const {
  return at_ >= bytes_.size() || IsLineEnd(bytes_[at_]);
}

void TextScanner::EndLine() {
  at_ += LineEndSize(bytes_, at_);
  ++line_;
}

void TextScanner::SkipBlanks() {
  while (at_ < bytes_.size()) {
    const char c = bytes_[at_];
    if (IsBlank(c)) {
      ++at_;
    } else if (c == comment_) {
      while (!AtLineEnd()) ++at_;
    } else if (continuation_ != 0 && c == continuation_ &&
               at_ + 1 < bytes_.size() && IsLineEnd(bytes_[at_ + 1])) {
      ++at_;
      EndLine();
    } else {
      break;
    }
  }
}

bool TextScanner::NextLine() {
  if (started_) {
    while (!AtLineEnd()) ++at_;
    if (at_ < bytes_.size()) EndLine();
  }
  started_ = true;
  SkipBlanks();
  while (at_ < bytes_.size() && IsLineEnd(bytes_[at_])) {
    EndLine();
    SkipBlanks();
  }
  word_line_ = line_;
  return at_ < bytes_.size();
}

std::string_view TextScanner::Word() {
  SkipBlanks();
  word_line_ = line_;
  const std::size_t begin = at_;
  while (!AtLineEnd() && !IsBlank(bytes_[at_]) && bytes_[at_] != comment_) {
    ++at_;
  }
  return bytes_.substr(begin, at_ - begin);
}

void TextScanner::EndRow() {
  const std::string_view word = Word();
  if (!word.empty()) Fail(Quoted(word), "expected the end of the line");
}

std::string_view TextScanner::Rest() const {
  const std::size_t end = bytes_.find_first_of("\r\n", at_);
  if (end == std::string_view::npos) return {};
  return bytes_.substr(end + LineEndSize(bytes_, end));
}

double TextScanner::ToNumber(std::string_view word, const char* what) const {
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  double value = 0;
  std::from_chars_result result = std::from_chars(digits.data(), end, value);
  if (result.ec == std::errc::result_out_of_range) {
    // Too large is infinite, too small is zero: the wider type tells which.
    long double wide = 0;
    result = std::from_chars(digits.data(), end, wide);
    value = static_cast<double>(wide);
  }
  if (result.ec != std::errc() || result.ptr != end || digits.empty()) {
    Fail(word.empty() ? "the line ends" : Quoted(word),
         std::string("expected a number (") + what + ")");
  }
  return value;
}

double TextScanner::Number(const char* what) {
  const std::string_view word = Word();
  const double value = ToNumber(word, what);
  if (!std::isfinite(value)) {
    Fail(Quoted(word), std::string("expected a finite number (") + what + ")");
  }
  return value;
}

std::int64_t TextScanner::ToInteger(std::string_view word,
                                    const char* what) const {
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || stop != end || digits.empty()) {
    Fail(word.empty() ? "the line ends" : Quoted(word),
         std::string("expected a whole number (") + what + ")");
  }
  return value;
}

void TextScanner::Fail(const std::string& value,
                       const std::string& expectation) const {
  throw InputError(name_ + ":" + std::to_string(word_line_) + ": " +
                   Printable(value + ": " + expectation));
}

}  // namespace invsim
