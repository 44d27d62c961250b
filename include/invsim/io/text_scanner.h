// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_IO_TEXT_SCANNER_H_
#define INVSIM_IO_TEXT_SCANNER_H_

// Walks through text line by line and word by word, and knows where it is, so
// that every complaint names the file and the line.

#include <cstdint>
#include <string>
#include <string_view>

namespace invsim {

// Text of a hostile file made fit for one line of an error message: anything
// but printable ASCII is shown as '?'.
std::string Printable(std::string_view text);
// The same in quotes, cut to 40 characters.
std::string Quoted(std::string_view word);

class TextScanner {
 public:
  // `bytes` must outlive the scanner. `comment` (0: none) starts a comment that
  // runs to the end of the line; `continuation` (0: none) before a line end
  // joins the next line on. `first_line` is the number of the first line.
  TextScanner(std::string_view bytes,
              const std::string& name,
              char comment,
              char continuation = 0,
              int first_line = 1)
      : bytes_(bytes),
        name_(name),
        comment_(comment),
        continuation_(continuation),
        line_(first_line),
        word_line_(first_line) {}

  // Moves to the next line that has a word; false at the end. Ends of lines
  // are \n, \r\n or \r.
  bool NextLine();
  // The next word of this line, separated by blanks; empty at its end.
  std::string_view Word();
  // The next word as a finite number; `what` names it in the complaint.
  double Number(const char* what);

  // Refuses any further word on this line.
  void EndRow();
  // Everything after the end of this line: some headers end in binary data.
  std::string_view Rest() const;

  // `word` as a number, finite or not; anything else is refused.
  double ToNumber(std::string_view word, const char* what) const;
  // `word` as an integer.
  std::int64_t ToInteger(std::string_view word, const char* what) const;

  // The line of the last word, from 1.
  int line() const { return word_line_; }

  // Throws InputError "name:line: value: expectation".
  [[noreturn]] void Fail(const std::string& value,
                         const std::string& expectation) const;

 private:
  void SkipBlanks();
  bool AtLineEnd() const;
  void EndLine();

  std::string_view bytes_;
  const std::string& name_;
  char comment_;
  char continuation_;
  std::size_t at_ = 0;
  int line_;       // of the character at at_
  int word_line_;  // of the last word
  bool started_ = false;
};

}  // namespace invsim

#endif  // INVSIM_IO_TEXT_SCANNER_H_
