// SPDX-License-Identifier: Apache-2.0

// Measures the parts listed in benchmarks.h on one thread and prints a table.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "benchmarks.h"
#include "invsim/base/threads.h"
#include "invsim/io/file.h"

int main(int argc, char** argv) {
  std::string filter;
  std::string json;
  int repeats = 7;
  CLI::App app("Benchmarks of invsim", "invsim_bench");
  app.add_option("--filter", filter, "only names that contain this text");
  app.add_option("--json", json, "also write the rows to this file");
  app.add_option("--repeats", repeats, "samples of each time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    invsim::SetThreads(1);
    invsim::Bench bench(filter, repeats);
    invsim::RunAllBenchmarks(&bench);
    std::cout << invsim::BenchTable(bench.rows());
    if (!json.empty()) {
      invsim::WriteFileBytes(json, invsim::BenchJson(bench.rows()));
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "invsim_bench: " << error.what() << std::endl;
    return 1;
  }
}
