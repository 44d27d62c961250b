// SPDX-License-Identifier: Apache-2.0
#ifndef INVSIM_REPORT_EVALUATION_REPORT_H_
#define INVSIM_REPORT_EVALUATION_REPORT_H_

// Metrics of runs (study/metrics.h), for programs and for people.

#include <string>
#include <vector>

#include "invsim/study/metrics.h"

namespace invsim {

inline constexpr int kEvaluationSchemaVersion = 1;

struct RunEvaluation {
  std::string run;      // the run's folder
  std::string truth;    // what it was held against
  std::string garment;  // the column of the results table it belongs to
  Metrics metrics;
};

// Schema "invsim.evaluation": `metrics` by key, `frames` with those of each
// frame.
std::string EvaluationJson(const RunEvaluation& evaluation);

// Schema "invsim.evaluations": the runs, without their frames, and the rows of
// the results table.
std::string EvaluationsJson(const std::vector<RunEvaluation>& evaluations);

// A key and its value per line.
std::string EvaluationText(const RunEvaluation& evaluation);

// One row per run, one column per key.
std::string EvaluationsCsv(const std::vector<RunEvaluation>& evaluations);

// Laid out as the paper's Table 1: Chamfer distances of body, cloth and what
// can be seen of both (rows), one column per garment, mean +- standard
// deviation over all frames of its runs, centimetres. The published figures
// stand beside, marked as of other data. Markdown.
std::string ResultsTable(const std::vector<RunEvaluation>& evaluations);

// Pages that open from disk (web_page.h): the distances frame by frame, and all
// figures; of several runs a curve for each garment, and the results table.
std::string EvaluationPage(const RunEvaluation& evaluation);
std::string EvaluationsPage(const std::vector<RunEvaluation>& evaluations);

// A published result to stand beside ours, millimetres.
struct PublishedResult {
  const char* row;   // "body"
  double low, high;  // over the paper's garments and motions
};
const std::vector<PublishedResult>& PublishedResults();

}  // namespace invsim

#endif  // INVSIM_REPORT_EVALUATION_REPORT_H_
