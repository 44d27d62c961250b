// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_SIMULATION_WRITER_H_
#define INVSIM_REPORT_SIMULATION_WRITER_H_

// Writes a simulation into its run folder: each frame as it is done, the rest
// at the end, however the run ended.

#include <vector>

#include "invsim/cloth/garment.h"
#include "invsim/cloth/material.h"
#include "invsim/report/run_folder.h"
#include "invsim/report/simulation_report.h"
#include "invsim/report/web_page.h"
#include "invsim/sim/rollout.h"

namespace invsim {

struct SimulationWriterOptions {
  bool ply = true;  // body/ and cloth/
  // Of a long sequence the page and scene.glb hold at most so many frames,
  // evenly spaced: they are for looking at.
  int most_poses = 60;
};
void Describe(OptionTable* table, SimulationWriterOptions* options);

class SimulationWriter {
 public:
  // All but `options` must outlive the writer; `frames_wanted` and
  // `frames_per_second` are the sequence's.
  SimulationWriter(const RunFolder& folder,
                   const Garment& garment,
                   const Material& material,
                   const Faces& body_faces,
                   int frames_wanted,
                   double frames_per_second,
                   const SimulationWriterOptions& options);

  // body/%06d.ply, cloth/%06d.ply; keeps what the page and cloth.pc2 need.
  // Throws InputError if a file cannot be written.
  void AddFrame(const SimulatedFrame& frame);

  // report.json, report.html, solver.txt, cloth.pc2, scene.glb. Takes over
  // frames and stress of `report`.
  void Finish(SimulationReport* report);

 private:
  WebPage Page(const SimulationReport& report);

  const RunFolder& folder_;
  const Garment& garment_;
  const Material& material_;
  const double frames_per_second_;
  const SimulationWriterOptions options_;
  int stride_;  // of the frames kept for looking at
  std::vector<Points> cloth_;
  std::vector<FrameStats> stats_;
  std::vector<double> stress_;
  std::vector<double> page_times_;
  PageMesh page_body_, page_cloth_;
};

}  // namespace invsim

#endif  // INVSIM_REPORT_SIMULATION_WRITER_H_
