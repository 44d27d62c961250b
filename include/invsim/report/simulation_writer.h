// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_SIMULATION_WRITER_H_
#define INVSIM_REPORT_SIMULATION_WRITER_H_

// Ends a simulation's run folder: what FrameWriter keeps, and the report in
// its three forms, however the run ended.

#include "invsim/report/frame_writer.h"
#include "invsim/report/simulation_report.h"

namespace invsim {

// report.json, report.html, solver.txt, cloth.pc2, scene.glb. `report` takes
// over frames and stress of `frames`.
void WriteSimulation(const RunFolder& folder,
                     FrameWriter* frames,
                     SimulationReport* report);

}  // namespace invsim

#endif  // INVSIM_REPORT_SIMULATION_WRITER_H_
