// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/simulation_writer.h"

#include "invsim/base/names.h"

namespace invsim {
namespace {

WebPage Page(const SimulationReport& report) {
  const FrameStats& sequence = report.sequence.stats;
  WebPage page;
  page.title = "Simulation: " + report.garment + " on " + report.body;
  page.lead = Verdict(report);
  page.facts = {
      {"body", report.body},
      {"motion", report.motion},
      {"garment", report.garment},
      {"material", report.material},
      {"cloth", std::to_string(report.cloth_vertices) + " vertices"},
      {"effects", Join(EffectsOn(report.effects))},
      {"friction", ShortNumber(report.friction)},
      {"frames",
       std::to_string(report.sequence.frames) + " of " +
           std::to_string(report.frames_wanted) + ", " +
           ShortNumber(report.frames_per_second) + " per second"},
      {"steps", std::to_string(sequence.step.substeps)},
      {"steps missed", std::to_string(sequence.step.missed)},
      {"worst residual",
       ShortNumber(sequence.step.worst_residual) + " of a vertex's weight"},
      {"penetration", ShortNumber(1000 * sequence.penetration.deepest) + " mm"},
      {"time for the sequence", ShortNumber(sequence.seconds) + " s"}};
  page.charts = SimulationCharts(report);
  page.details = SimulationText(report);
  return page;
}

}  // namespace

void WriteSimulation(const RunFolder& folder,
                     FrameWriter* frames,
                     SimulationReport* report) {
  report->frames = frames->stats();
  report->stress = frames->stress();
  folder.Write("report.json", SimulationJson(*report));
  folder.Write("solver.txt", SimulationText(*report));
  frames->WriteSequence();
  WebPage page = Page(*report);
  frames->AddViewer(&page);
  folder.Write("report.html", FormatWebPage(page));
}

}  // namespace invsim
