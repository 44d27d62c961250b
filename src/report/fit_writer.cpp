// SPDX-License-Identifier: Apache-2.0
#include "invsim/report/fit_writer.h"

#include "invsim/base/names.h"
#include "invsim/body/motion.h"

namespace invsim {
namespace {

Motion AsMotion(const BodySequence& body, double frames_per_second) {
  Motion motion;
  motion.frame_rate = frames_per_second;
  motion.shape = body.shape;
  motion.poses = body.poses;
  motion.translations = body.translations;
  return motion;
}

WebPage Page(const FitReport& report) {
  const FitResult& r = report.result;
  WebPage page;
  page.title = "Fit: " + report.points;
  page.lead = Verdict(report);
  page.facts = {{"points", report.points},
                {"body", report.body},
                {"garment", report.garment},
                {"material", report.material},
                {"frames", std::to_string(report.frames)},
                {"cloth", std::to_string(report.cloth_vertices) + " vertices"},
                {"effects", Join(EffectsOn(report.effects))},
                {"optimiser", report.optimizer},
                {"ended", Name(r.termination)},
                {"simulation steps", std::to_string(r.stats.step.substeps)},
                {"steps missed", std::to_string(r.stats.step.missed)},
                {"time", ShortNumber(report.seconds) + " s"}};
  page.charts = FitCharts(report);
  page.details = FitText(report);
  return page;
}

}  // namespace

void WriteFit(const RunFolder& folder, FrameWriter* frames, FitReport* report) {
  report->simulated = frames->stats();
  WriteMotion(folder.File("body.npz"),
              AsMotion(report->result.body, report->frames_per_second));
  folder.Write("report.json", FitJson(*report));
  folder.Write("solver.txt", FitText(*report));
  folder.Write("iterations.csv", IterationsCsv(*report));
  frames->WriteSequence();
  WebPage page = Page(*report);
  frames->AddViewer(&page);
  folder.Write("report.html", FormatWebPage(page));
}

}  // namespace invsim
