// SPDX-License-Identifier: Apache-2.0
#include "sweep_runs.h"

#include <algorithm>
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

Json ReadObject(const std::string& path) {
  if (!fs::exists(path)) return Json::object();
  Json json = Json::parse(ReadFileBytes(path), nullptr, false);
  return json.is_object() ? json : Json::object();
}

// The number at "a.b.c"; false if there is none.
bool FindNumber(const Json& json, const std::string& key, double* value) {
  const Json* node = &json;
  std::istringstream parts(key);
  for (std::string part; std::getline(parts, part, '.');) {
    if (!node->is_object() || !node->contains(part)) return false;
    node = &node->at(part);
  }
  if (!node->is_number()) return false;
  *value = node->get<double>();
  return true;
}

std::string LastLine(const std::string& path) {
  if (!fs::exists(path)) return "";
  std::istringstream text(ReadFileBytes(path));
  std::string last;
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) last = line;
  return last;
}

// Processor time per second of the simulated sequence: of the processor time
// of the run the share that the sequence took of its wall clock. (Loading,
// dressing and writing are not what a setting of the step is judged by.)
bool CpuPerSimulatedSecond(const Json& report,
                           const SweepRun& run,
                           double* value) {
  double seconds = 0, frames = 0, rate = 0;
  if (!FindNumber(report, "sequence.seconds.total", &seconds) ||
      !FindNumber(report, "counts.frames_done", &frames) ||
      !FindNumber(report, "inputs.frames_per_second", &rate) || frames < 2 ||
      run.wall_seconds <= 0)
    return false;
  *value = run.cpu_seconds * (seconds / run.wall_seconds) * rate / (frames - 1);
  return true;
}

}  // namespace

SweepRuns::SweepRuns(const std::string& folder, std::vector<std::string> common)
    : folder_(folder), common_(std::move(common)) {}

std::string SweepRuns::Path(const SweepSetting& setting,
                            int repeat,
                            const std::string& extension) const {
  return (fs::path(folder_) / "runs" / setting.name /
          (std::to_string(repeat) + extension))
      .string();
}

std::string SweepRuns::Folder(const SweepSetting& setting, int repeat) const {
  return Path(setting, repeat, "");
}

std::vector<std::string> SweepRuns::Arguments(const SweepSetting& setting,
                                              int repeat) const {
  std::vector<std::string> arguments = common_;
  for (const auto& [key, value] : setting.options)
    arguments.insert(arguments.end(), {"--set", key + "=" + value});
  return arguments;
}

bool SweepRuns::Done(const SweepSetting& setting, int repeat) const {
  const std::string record = Path(setting, repeat, ".json");
  const Json json = ReadObject(record);
  if (!json.contains("exit_code")) return false;
  if (json.value("arguments", std::vector<std::string>()) !=
      Arguments(setting, repeat))
    throw UsageError(record +
                     ": done with other options than are asked for "
                     "now; choose another --out, or --force to run all again");
  return true;
}

void SweepRuns::Forget(const SweepSetting& setting, int repeat) const {
  for (const char* extension : {".json", ".log", ""})
    fs::remove_all(Path(setting, repeat, extension));
}

SweepRun SweepRuns::Run(const SweepSetting& setting, int repeat) const {
  const std::string record = Path(setting, repeat, ".json");
  if (Done(setting, repeat)) {
    const Json json = ReadObject(record);
    return {json.value("exit_code", -1),
            json.value("wall_seconds", 0.0),
            json.value("cpu_seconds", 0.0)};
  }
  const std::string folder = Folder(setting, repeat);
  fs::create_directories(fs::path(folder).parent_path());
  fs::remove_all(folder);  // what an interrupted run left
  std::vector<std::string> arguments = Arguments(setting, repeat);
  const Json kept = arguments;
  arguments.insert(arguments.end(), {"--out", folder});
  const ChildResult child = RunChild(arguments, Path(setting, repeat, ".log"));
  const SweepRun run{child.exit_code, child.wall_seconds, child.cpu_seconds};
  if (run.exit_code == static_cast<int>(ExitCode::kInterrupted)) return run;
  Json json;
  json["arguments"] = kept;
  json["exit_code"] = run.exit_code;
  json["wall_seconds"] = run.wall_seconds;
  json["cpu_seconds"] = run.cpu_seconds;
  WriteFileBytes(record, json.dump(2) + "\n");
  return run;
}

SweepResult SweepRuns::Result(
    const SweepSetting& setting,
    int repeats,
    const std::vector<std::string>& report_keys) const {
  SweepResult result;
  result.setting = setting;
  result.usable = true;
  std::vector<double> wall, cpu, simulation;
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
  for (const std::string& key : report_keys) numbers.push_back({key, {}});
  for (int k = 0; k < repeats; ++k) {
    const SweepRun run = Run(setting, k);
    result.exit_codes.push_back(run.exit_code);
    wall.push_back(run.wall_seconds);
    cpu.push_back(run.cpu_seconds);
    if (!run.usable()) {
      result.usable = false;
      result.failure = LastLine(Path(setting, k, ".log"));
    }
    const Json report = ReadObject(Folder(setting, k) + "/report.json");
    double value = 0;
    if (CpuPerSimulatedSecond(report, run, &value)) simulation.push_back(value);
    for (auto& [key, values] : numbers)
      if (FindNumber(report, key, &value)) values.push_back(value);
  }
  const auto add = [&](const std::string& key, const std::vector<double>& v) {
    if (v.empty()) return;
    const SweepSpread spread = SpreadOf(v);
    result.values.emplace_back(key, spread.median);
    if (v.size() < 2 || spread.least == spread.largest) return;
    result.values.emplace_back(key + "_least", spread.least);
    result.values.emplace_back(key + "_largest", spread.largest);
  };
  add("wall_seconds", wall);
  add("cpu_seconds", cpu);
  add("cpu_per_simulated_second", simulation);
  for (const auto& [key, values] : numbers) add(key, values);
  return result;
}

}  // namespace invsim
