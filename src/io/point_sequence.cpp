// SPDX-License-Identifier: Apache-2.0
#include "invsim/io/point_sequence.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>

#include "invsim/base/error.h"
#include "invsim/base/names.h"
#include "invsim/io/file.h"
#include "invsim/io/point_cloud.h"
#include "invsim/io/text_scanner.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

// A file name taken apart: "scan_007.left.ply" is "scan_", "007", ".left.ply".
struct FrameName {
  std::string name;
  std::string before;
  std::string digits;
  std::string after;
  std::int64_t number = 0;
};

// The names of the point clouds in a directory, sorted.
std::vector<std::string> PointFileNames(const std::string& directory) {
  std::error_code error;
  fs::directory_iterator entries(directory, error);
  if (error) {
    throw InputError(directory + ": " + error.message() +
                     ": expected a directory of point clouds");
  }
  const std::vector<std::string>& known = PointExtensions();
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name[0] == '.' || entry.is_directory(error)) continue;
    const bool is_point_cloud =
        std::find(known.begin(), known.end(), LowerExtension(name)) !=
        known.end();
    if (is_point_cloud) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  if (names.empty()) {
    throw InputError(directory + ": no point cloud: expected files " +
                     Join(known) + ", one per frame");
  }
  return names;
}

FrameName TakeApart(const std::string& directory, const std::string& name) {
  const auto is_digit = [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  };
  std::size_t end = name.rfind('.');  // digits of the extension do not count
  while (end > 0 && !is_digit(name[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  FrameName frame{name,
                  name.substr(0, begin),
                  name.substr(begin, end - begin),
                  name.substr(end)};
  const char* last = frame.digits.data() + frame.digits.size();
  const auto [stop, error] =
      std::from_chars(frame.digits.data(), last, frame.number);
  if (error != std::errc()) {
    throw InputError(directory + ": " + Quoted(name) +
                     ": expected a frame number in the name");
  }
  return frame;
}

// Refuses two extensions or two namings.
void CheckSameNaming(const std::string& directory,
                     const FrameName& a,
                     const FrameName& b) {
  if (a.before == b.before && a.after == b.after) return;
  throw InputError(directory + ": " + Quoted(a.name) + " and " +
                   Quoted(b.name) +
                   ": expected names that differ in the frame number only");
}

// The name that the frame of this number would have.
std::string NameOf(std::int64_t number, const FrameName& like) {
  std::string digits = std::to_string(number);
  if (digits.size() < like.digits.size()) {
    digits.insert(0, like.digits.size() - digits.size(), '0');
  }
  return like.before + digits + like.after;
}

// The common distance of the numbers; refuses one twice and a gap.
std::int64_t CheckNumbers(const std::string& directory,
                          const std::vector<FrameName>& frames) {
  if (frames.size() < 2) return 1;
  std::int64_t step = frames[1].number - frames[0].number;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::int64_t gap = frames[i].number - frames[i - 1].number;
    if (gap == 0) {
      throw InputError(directory + ": " + Quoted(frames[i - 1].name) + " and " +
                       Quoted(frames[i].name) +
                       ": expected each frame number once");
    }
    step = std::min(step, gap);
  }
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const FrameName& last = frames[i - 1];
    if (frames[i].number - last.number == step) continue;
    throw InputError(
        directory + ": frame " + std::to_string(last.number + step) +
        " is missing: expected " + Quoted(NameOf(last.number + step, last)) +
        " between " + Quoted(last.name) + " and " + Quoted(frames[i].name));
  }
  return step;
}

}  // namespace

PointSequence ScanPointSequence(const std::string& directory) {
  std::vector<FrameName> frames;
  for (const std::string& name : PointFileNames(directory)) {
    frames.push_back(TakeApart(directory, name));
    CheckSameNaming(directory, frames.front(), frames.back());
  }
  std::stable_sort(
      frames.begin(), frames.end(), [](const FrameName& a, const FrameName& b) {
        return a.number < b.number;
      });
  PointSequence sequence;
  sequence.directory = directory;
  sequence.first = frames.front().number;
  sequence.step = CheckNumbers(directory, frames);
  for (const FrameName& frame : frames) {
    const fs::path path = fs::path(directory) / frame.name;
    std::error_code error;
    if (fs::file_size(path, error) == 0 || error) {
      throw InputError(path.string() +
                       ": empty or unreadable: expected a point cloud");
    }
    sequence.files.push_back(path.string());
  }
  return sequence;
}

}  // namespace invsim
