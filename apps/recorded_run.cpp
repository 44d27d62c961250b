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

namespace invsim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// An empty object if there is no record that can be read.
Json ReadRecord(const std::string& path) {
  if (!fs::exists(path)) return Json::object();
  Json json = Json::parse(ReadFileBytes(path), nullptr, false);
  return json.is_object() ? json : Json::object();
}

}  // namespace

RecordedRun::RecordedRun(std::string path, std::vector<std::string> arguments)
    : path_(std::move(path)), arguments_(std::move(arguments)) {}

RunOutcome RecordedRun::Run() const {
  const std::string record = path_ + ".json";
  const Json done = ReadRecord(record);
  if (done.contains("exit_code")) {
    if (done.value("arguments", std::vector<std::string>()) != arguments_)
      throw UsageError(record +
                       ": done with other options than are asked for now; "
                       "choose another --out, or --force to run all again");
    return {done.value("exit_code", -1),
            done.value("wall_seconds", 0.0),
            done.value("cpu_seconds", 0.0)};
  }
  fs::create_directories(fs::path(path_).parent_path());
  fs::remove_all(path_);  // what an interrupted run left
  std::vector<std::string> arguments = arguments_;
  arguments.insert(arguments.end(), {"--out", path_});
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
  for (const char* extension : {".json", ".log", ""})
    fs::remove_all(path_ + extension);
}

void RecordedRun::ForgetIfKilled() const {
  const int signal =
      SignalOf(ReadRecord(path_ + ".json").value("exit_code", 0));
  if (signal == SIGKILL || signal == SIGTERM || signal == SIGHUP) Forget();
}

std::string RecordedRun::LastLine() const {
  const int exit_code = ReadRecord(path_ + ".json").value("exit_code", 0);
  if (const int signal = SignalOf(exit_code))
    return "ended by signal " + std::to_string(signal) + " (" +
           strsignal(signal) + ")";
  const std::string log = path_ + ".log";
  if (!fs::exists(log)) return "";
  std::istringstream text(ReadFileBytes(log));
  std::string last;
  for (std::string line; std::getline(text, line);)
    if (!line.empty() && line != path_) last = line;
  return last;
}

}  // namespace invsim
