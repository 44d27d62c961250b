// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_FIT_WRITER_H_
#define INVSIM_REPORT_FIT_WRITER_H_

// Ends a fit's run folder: body.npz, what FrameWriter keeps, and the report in
// its forms (report.json, report.html, solver.txt, iterations.csv).

#include "invsim/report/fit_report.h"
#include "invsim/report/frame_writer.h"

namespace invsim {

// `report` takes over the statistics of `frames`.
void WriteFit(const RunFolder& folder, FrameWriter* frames, FitReport* report);

}  // namespace invsim

#endif  // INVSIM_REPORT_FIT_WRITER_H_
