// SPDX-License-Identifier: Apache-2.0
#include "sweep_runs.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

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

// Processor time per second of the simulated sequence. (Loading, dressing and
// writing are not what a setting of the step is judged by.)
bool CpuPerSimulatedSecond(const Json& report, double* value) {
  double seconds = 0, frames = 0, rate = 0;
  if (!FindNumber(report, "sequence.seconds.processor", &seconds) ||
      !FindNumber(report, "counts.frames_done", &frames) ||
      !FindNumber(report, "inputs.frames_per_second", &rate) || frames < 2)
    return false;
  *value = seconds * rate / (frames - 1);
  return true;
}

}  // namespace

SweepRuns::SweepRuns(std::string folder, std::vector<std::string> common)
    : folder_(std::move(folder)), common_(std::move(common)) {}

RecordedRun SweepRuns::At(const SweepSetting& setting, int repeat) const {
  const fs::path path =
      fs::path(folder_) / "runs" / setting.name / std::to_string(repeat);
  std::vector<std::string> arguments = common_;
  for (const auto& [key, value] : setting.options)
    arguments.insert(arguments.end(), {"--set", key + "=" + value});
  return RecordedRun(path.string(), std::move(arguments));
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
    const RecordedRun recorded = At(setting, k);
    const RunOutcome run = recorded.Run();
    result.exit_codes.push_back(run.exit_code);
    wall.push_back(run.wall_seconds);
    cpu.push_back(run.cpu_seconds);
    if (!run.usable()) {
      result.usable = false;
      result.failure = recorded.LastLine();
    }
    const Json report = ReadObject(recorded.folder() + "/report.json");
    double value = 0;
    if (CpuPerSimulatedSecond(report, &value)) simulation.push_back(value);
    for (auto& [key, values] : numbers)
      if (FindNumber(report, key, &value)) values.push_back(value);
  }
  result.Add("wall_seconds", wall);
  result.Add("cpu_seconds", cpu);
  result.Add("cpu_per_simulated_second", simulation);
  for (const auto& [key, values] : numbers) result.Add(key, values);
  return result;
}

}  // namespace invsim
