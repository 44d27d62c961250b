// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/soak_report.h"

#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "text_line.h"

namespace invsim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kSeedsShown = 12;
constexpr size_t kScenesShown = 20;

using SeedsByLimit = std::map<std::string, std::vector<std::uint64_t>>;

SeedsByLimit ByLimit(const SoakResult& result) {
  SeedsByLimit seeds;
  for (const SoakFailure& failure : result.failures)
    for (const Breach& breach : failure.broken)
      seeds[breach.limit].push_back(failure.seed);
  return seeds;
}

double Percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

// "3 scenes (0.1 %), seeds 5 17 99"
std::string SeedsText(const std::vector<std::uint64_t>& seeds, int scenes) {
  std::string text = Line("%d scenes (%.2g %%), seeds",
                          static_cast<int>(seeds.size()),
                          Percent(seeds.size(), scenes));
  for (size_t k = 0; k < seeds.size() && k < kSeedsShown; ++k)
    text += " " + std::to_string(seeds[k]);
  return text + (seeds.size() > kSeedsShown ? " ...\n" : "\n");
}

std::string FailuresText(const SoakResult& result) {
  std::string text;
  for (const auto& [limit, seeds] : ByLimit(result)) {
    text += Line("%-22s ", limit.c_str()) + SeedsText(seeds, result.scenes);
  }
  for (const auto& [border, seeds] : result.borders)
    text += "border: " + border + "\n" + std::string(23, ' ') +
            SeedsText(seeds, result.scenes);
  if (!result.failures.empty()) text += "\n";
  for (size_t k = 0; k < result.failures.size() && k < kScenesShown; ++k) {
    const SoakFailure& failure = result.failures[k];
    text += "seed " + std::to_string(failure.seed) + ": ";
    for (const Breach& breach : failure.broken) text += breach.text + "; ";
    text += "\n    " + failure.words + "\n";
  }
  if (result.failures.size() > kScenesShown)
    text += Line("and %d more\n",
                 static_cast<int>(result.failures.size() - kScenesShown));
  return text;
}

}  // namespace

std::string SoakText(const SoakResult& r) {
  const StepStats& s = r.step;
  std::string text;
  text += Line("%-22s %d, seeds from %llu on\n",
               "scenes",
               r.scenes,
               static_cast<unsigned long long>(r.first_seed));
  text += Line("%-22s in %d scenes\n", "contacts", r.scenes_touching);
  text += Line("%-22s %d\n", "frames", r.frames);
  text += Line("%-22s %d\n", "steps", s.substeps);
  text += Line("%-22s %.4f %%\n",
               "steps converged",
               Percent(s.substeps - s.missed, s.substeps));
  text += Line("%-22s %d in %d scenes\n", "missed", s.missed, r.scenes_missed);
  text += Line("%-22s %d in %d scenes\n", "halved", s.halved, r.scenes_halved);
  text += Line("%-22s %.2g weights\n", "worst residual", s.worst_residual);
  text += Line("%-22s %.3g mm\n", "worst penetration", 1e3 * r.penetration);
  text += Line("%-22s %.2g\n", "worst energy breach", r.energy);
  text += Line("%-22s %d scenes, %d columns (%d switched), worst %.1e\n",
               "derivatives",
               r.derivatives,
               r.columns,
               r.switched,
               r.derivative);
  text += Line("%-22s %.0f s\n", "time", r.seconds);
  text +=
      Line("%-22s %d\n", "failing scenes", static_cast<int>(r.failures.size()));
  return text + FailuresText(r);
}

std::string SoakJson(const SoakResult& r) {
  Json json;
  json["schema"] = "invsim.soak";
  json["schema_version"] = kSoakSchemaVersion;
  json["first_seed"] = r.first_seed;
  json["scenes"] = r.scenes;
  json["frames"] = r.frames;
  json["substeps"] = r.step.substeps;
  json["substeps_missed"] = r.step.missed;
  json["substeps_halved"] = r.step.halved;
  json["substeps_failed"] = r.step.failed;
  json["scenes_with_missed_steps"] = r.scenes_missed;
  json["scenes_with_halved_steps"] = r.scenes_halved;
  json["scenes_with_contacts"] = r.scenes_touching;
  json["worst_residual_weights"] = r.step.worst_residual;
  json["penetration_max_mm"] = 1e3 * r.penetration;
  json["energy_gain_relative"] = r.energy;
  json["derivative_scenes"] = r.derivatives;
  json["derivative_columns"] = r.columns;
  json["derivative_columns_switched"] = r.switched;
  json["derivative_relative_error"] = r.derivative;
  json["seconds"] = r.seconds;
  json["failing_seeds"] = Json::object();
  for (const auto& [limit, seeds] : ByLimit(r))
    json["failing_seeds"][limit] = seeds;
  json["borders"] = Json::object();
  for (const auto& [border, seeds] : r.borders) json["borders"][border] = seeds;
  json["failures"] = Json::array();
  for (const SoakFailure& failure : r.failures) {
    Json row{{"seed", failure.seed}, {"scene", failure.words}};
    for (const Breach& breach : failure.broken)
      row["broken"].push_back(breach.text);
    json["failures"].push_back(std::move(row));
  }
  return json.dump(2) + "\n";
}

}  // namespace invsim
