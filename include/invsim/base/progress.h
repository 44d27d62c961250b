// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_BASE_PROGRESS_H_
#define INVSIM_BASE_PROGRESS_H_

// Progress through a known number of items with the time left, written to a
// stream the caller chooses: one line that redraws itself on a terminal, one
// line per item anywhere else (a log file, a batch system).
//
//   Progress progress(&std::cerr, StyleFor(STDERR_FILENO), "frames", 60);
//   for (...) { ...; progress.Advance("12 contacts"); }
//
//   frames 12/60  eta 0:35  12 contacts

#include <functional>
#include <ostream>
#include <string>

namespace invsim {

struct ProgressStyle {
  bool bar = false;    // redraw one line, with a bar
  bool color = false;  // the bar in colour
};

// A bar if the descriptor is a terminal that can redraw, in colour unless the
// environment has a non-empty NO_COLOR.
ProgressStyle StyleFor(int file_descriptor);

// Seconds as "0:07", "12:34" or "1:02:03".
std::string ClockText(double seconds);

class Progress {
 public:
  // Seconds since any fixed moment.
  using Clock = std::function<double()>;

  // Writes nothing if `out` is null (quiet). `title` names the items. The
  // clock is the steady one unless given.
  Progress(std::ostream* out,
           ProgressStyle style,
           std::string title,
           int total,
           Clock clock = {});
  // Ends the bar's line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // So many more items are done; `note` says something about them in few words.
  void Advance(const std::string& note = "", int items = 1);

 private:
  std::string Line(double elapsed, const std::string& note) const;
  std::string Bar() const;
  void Redraw(const std::string& line);

  std::ostream* out_;
  ProgressStyle style_;
  std::string title_;
  int total_;
  Clock clock_;
  double start_;
  double last_drawn_;
  int done_ = 0;
  size_t drawn_width_ = 0;  // of the line now on the terminal
};

}  // namespace invsim

#endif  // INVSIM_BASE_PROGRESS_H_
