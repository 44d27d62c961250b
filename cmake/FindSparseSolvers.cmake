# The sparse solvers of SuiteSparse that we call, and the BLAS below them; Debian
# 12 ships no CMake package for them. Installed with invsim, whose users link
# the static libraries. OpenBLAS is named so that it is the one in use whatever
# the system's libblas.so.3 is.
#
#   SparseSolvers::SparseSolvers
include(FindPackageHandleStandardArgs)

find_path(SparseSolvers_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(libraries "")
set(variables SparseSolvers_INCLUDE_DIR)
foreach(name cholmod openblas)
  find_library(SparseSolvers_${name}_LIBRARY ${name})
  mark_as_advanced(SparseSolvers_${name}_LIBRARY)
  list(APPEND libraries ${SparseSolvers_${name}_LIBRARY})
  list(APPEND variables SparseSolvers_${name}_LIBRARY)
endforeach()
mark_as_advanced(SparseSolvers_INCLUDE_DIR)
find_package_handle_standard_args(SparseSolvers REQUIRED_VARS ${variables})

if(SparseSolvers_FOUND AND NOT TARGET SparseSolvers::SparseSolvers)
  add_library(SparseSolvers::SparseSolvers INTERFACE IMPORTED)
  set_target_properties(SparseSolvers::SparseSolvers PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${SparseSolvers_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${libraries}")
endif()
