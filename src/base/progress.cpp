// SPDX-License-Identifier: Apache-2.0
#include "invsim/base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace invsim {
namespace {

constexpr int kBarWidth = 24;
constexpr double kRedrawSeconds = 0.1;
constexpr char kColorOn[] = "\x1b[36m";
constexpr char kColorOff[] = "\x1b[0m";

double SteadySeconds() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string_view Environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

ProgressStyle StyleFor(int file_descriptor) {
  ProgressStyle style;
  const std::string_view terminal = Environment("TERM");
  style.bar =
      isatty(file_descriptor) && !terminal.empty() && terminal != "dumb";
  style.color = style.bar && Environment("NO_COLOR").empty();
  return style;
}

std::string ClockText(double seconds) {
  const long long s = std::llround(std::max(seconds, 0.0));
  char text[40];
  if (s < 3600)
    std::snprintf(text, sizeof(text), "%lld:%02lld", s / 60, s % 60);
  else
    std::snprintf(text,
                  sizeof(text),
                  "%lld:%02lld:%02lld",
                  s / 3600,
                  s / 60 % 60,
                  s % 60);
  return text;
}

Progress::Progress(std::ostream* out,
                   ProgressStyle style,
                   std::string title,
                   int total,
                   Clock clock)
    : out_(out),
      style_(style),
      title_(std::move(title)),
      total_(total),
      clock_(clock ? std::move(clock) : SteadySeconds),
      start_(clock_()),
      last_drawn_(start_ - kRedrawSeconds) {}

Progress::~Progress() {
  if (out_ && drawn_width_ > 0) *out_ << "\n" << std::flush;
}

void Progress::Advance(const std::string& note, int items) {
  done_ += items;
  if (!out_) return;
  const double now = clock_();
  const std::string line = Line(now - start_, note);
  if (!style_.bar) {
    *out_ << line << "\n" << std::flush;
  } else if (done_ >= total_ || now - last_drawn_ >= kRedrawSeconds) {
    last_drawn_ = now;
    Redraw(line);
  }
}

std::string Progress::Line(double elapsed, const std::string& note) const {
  std::string line =
      title_ + " " + std::to_string(done_) + "/" + std::to_string(total_);
  // The items still to do are taken to be like those done.
  if (done_ < total_)
    line += "  eta " + ClockText(elapsed / done_ * (total_ - done_));
  else
    line += "  in " + ClockText(elapsed);
  if (!note.empty()) line += "  " + note;
  return line;
}

std::string Progress::Bar() const {
  const int filled =
      total_ > 0 ? std::min(kBarWidth, kBarWidth * done_ / total_) : kBarWidth;
  const std::string full(filled, '#');
  const std::string rest(kBarWidth - filled, '-');
  if (!style_.color) return "[" + full + rest + "] ";
  return "[" + (kColorOn + full) + kColorOff + rest + "] ";
}

void Progress::Redraw(const std::string& line) {
  // Blanks wipe what a longer line before left behind.
  const size_t width = kBarWidth + 3 + line.size();
  *out_ << "\r" << Bar() << line
        << std::string(drawn_width_ > width ? drawn_width_ - width : 0, ' ')
        << std::flush;
  drawn_width_ = width;
}

}  // namespace invsim
