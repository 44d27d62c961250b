// SPDX-License-Identifier: Apache-2.0
#include "recorded_run.h"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "child_process.h"
#include "exit_code.h"
#include "invsim/base/error.h"
#include "invsim/io/file.h"
#include "invsim/io/json_record.h"

namespace invsim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A log begins with the command it is of.
constexpr char kLogStart[] = "$ invsim ";

// An empty one if the run is not done. Throws UsageError if the file is
// something else.
JsonRecord ReadRecord(const std::string& path) {
  JsonRecord record = JsonRecord::Read(path);
  if (fs::exists(path) && !(record.Has("exit_code") && record.Has("arguments")))
    throw UsageError(path +
                     ": is no record of a run; choose another --out, nothing "
                     "is replaced unasked");
  return record;
}

void CheckLog(const std::string& path) {
  if (fs::exists(path) && !ReadFileBytes(path).starts_with(kLogStart))
    throw UsageError(path +
                     ": is no log of a run; choose another --out, nothing is "
                     "replaced unasked");
}

}  // namespace

RecordedRun::RecordedRun(std::string path, std::vector<std::string> arguments)
    : path_(std::move(path)), arguments_(std::move(arguments)) {}

RunOutcome RecordedRun::Run() const {
  const std::string record = path_ + ".json";
  const JsonRecord done = ReadRecord(record);
  if (done.Has("exit_code")) {
    if (done.Texts("arguments") != arguments_)
      throw UsageError(record +
                       ": done with other options than are asked for now; "
                       "choose another --out, or --force to run all again");
    return {done.Integer("exit_code", -1),
            done.Number("wall_seconds", 0),
            done.Number("cpu_seconds", 0)};
  }
  CheckLog(path_ + ".log");
  fs::create_directories(fs::path(path_).parent_path());
  // It replaces what an interrupted run left, and nothing else.
  std::vector<std::string> arguments = arguments_;
  arguments.insert(arguments.end(), {"--force", "--out", path_});
  const ChildResult child = RunChild(arguments, path_ + ".log");
  const RunOutcome run{child.exit_code, child.wall_seconds, child.cpu_seconds};
  if (run.exit_code == static_cast<int>(ExitCode::kInterrupted)) return run;
  Json json;
  json["arguments"] = arguments_;
  json["exit_code"] = run.exit_code;
  json["wall_seconds"] = run.wall_seconds;
  json["cpu_seconds"] = run.cpu_seconds;
  WriteFileBytes(record, json.dump(2) + "\n");
  return run;
}

void RecordedRun::Forget() const {
  ReadRecord(path_ + ".json");  // not to remove what is none
  fs::remove(path_ + ".json");
}

void RecordedRun::ForgetIfKilled() const {
  const int signal =
      SignalOf(ReadRecord(path_ + ".json").Integer("exit_code", 0));
  if (signal == SIGKILL || signal == SIGTERM || signal == SIGHUP) Forget();
}

std::string RecordedRun::LastLine() const {
  const int exit_code = ReadRecord(path_ + ".json").Integer("exit_code", 0);
  if (const int signal = SignalOf(exit_code))
    return "ended by signal " + std::to_string(signal) + " (" +
           strsignal(signal) + ")";
  const std::string log = path_ + ".log";
  if (!fs::exists(log)) return "";
  std::istringstream text(ReadFileBytes(log));
  std::string last;
  for (std::string line; std::getline(text, line);)
    if (!line.empty() && line != path_ && !line.starts_with(kLogStart))
      last = line;
  return last;
}

}  // namespace invsim
