// SPDX-License-Identifier: Apache-2.0
#include "version.h"

#include <SuiteSparse_config.h>
#include <cblas.h>
#include <ceres/version.h>

#include <Eigen/Core>

namespace invsim {

std::string ProgramVersion() {
  const auto dotted = [](int a, int b, int c) {
    return std::to_string(a) + "." + std::to_string(b) + "." +
           std::to_string(c);
  };
  return std::string("invsim " INVSIM_VERSION "\nCeres ") +
         CERES_VERSION_STRING + "\nEigen " +
         dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) +
         "\nSuiteSparse " +
         dotted(SUITESPARSE_MAIN_VERSION,
                SUITESPARSE_SUB_VERSION,
                SUITESPARSE_SUBSUB_VERSION) +
         "\n";
}

std::string VersionText() {
  return ProgramVersion() + "BLAS " + openblas_get_config() + "\n";
}

}  // namespace invsim
