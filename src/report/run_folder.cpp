// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/run_folder.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "invsim/base/error.h"
#include "invsim/io/earlier_results.h"
#include "invsim/io/file.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFiles[] = {"report.json",
                                  "report.html",
                                  "solver.txt",
                                  "iterations.csv",
                                  "comparison.csv",
                                  "comparison.svg",
                                  "body.npz",
                                  "cloth.pc2",
                                  "scene.glb",
                                  kResolvedConfig};
constexpr const char* kFrameFolders[] = {"body", "cloth"};
constexpr const char* kCheckpoint = "checkpoint";

bool IsFrame(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".ply" && stem.size() >= 6 &&
         std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
           return std::isdigit(c);
         });
}

// What a run may have left in the folder.
std::vector<fs::path> FilesOfRun(const fs::path& folder) {
  std::vector<fs::path> files = {folder / kCheckpoint};
  for (const char* kind : kFrameFolders) {
    if (!fs::is_directory(folder / kind)) continue;
    for (const auto& entry : fs::directory_iterator(folder / kind))
      if (IsFrame(entry.path())) files.push_back(entry.path());
  }
  for (const char* file : kFiles) files.push_back(folder / file);
  return files;
}

}  // namespace

RunFolder::RunFolder(const std::string& path,
                     bool force,
                     const std::vector<std::string>& inputs)
    : path_(path) {
  try {
    if (fs::exists(path) && !fs::is_directory(path))
      throw UsageError(path + ": is a file, expected a folder for the results");
    fs::create_directories(path);
    lock_ = std::make_shared<FolderLock>(path);
    if (!fs::is_empty(path)) {
      if (!force)
        throw UsageError(path +
                         ": the folder is not empty; choose another one, or "
                         "--force to replace the run in it");
      RemoveEarlierResults(path, FilesOfRun(path), inputs);
    }
    // Better to learn now than after an hour that nothing can be written.
    const std::string probe = File(".writable");
    WriteFileBytes(probe, "");
    fs::remove(probe);
  } catch (const fs::filesystem_error& error) {
    throw InputError(
        path + ": cannot be used for the results: " + error.code().message());
  }
}

RunFolder RunFolder::Reopen(const std::string& path) {
  if (!fs::is_directory(fs::path(path) / kCheckpoint))
    throw UsageError(path + ": no run to resume there (expected a folder " +
                     kCheckpoint + " in it)");
  return RunFolder(path);
}

std::string RunFolder::Checkpoint() const {
  std::error_code error;
  fs::create_directories(fs::path(path_) / kCheckpoint, error);
  if (error)
    throw InputError(File(kCheckpoint) +
                     ": cannot be made: " + error.message());
  return File(kCheckpoint);
}

std::string RunFolder::File(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

std::string RunFolder::Frame(const std::string& kind, int frame) const {
  std::error_code ignored;  // writing there says what is wrong
  fs::create_directories(fs::path(path_) / kind, ignored);
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.ply", frame);
  return (fs::path(path_) / kind / name).string();
}

void RunFolder::Write(const std::string& name, std::string_view bytes) const {
  WriteFileBytes(File(name), bytes);
}

}  // namespace invsim
