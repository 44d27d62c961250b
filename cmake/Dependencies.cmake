# Everything invsim links, found once. Versions and licences are in
# third_party_notes.md.
set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(glog REQUIRED)
find_package(TBB REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ZLIB REQUIRED)
find_package(embree 3 REQUIRED)

# SuiteSparse ships no CMake package in Debian 12.
add_library(SuiteSparse INTERFACE)
find_path(SUITESPARSE_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
target_include_directories(SuiteSparse SYSTEM INTERFACE
                           ${SUITESPARSE_INCLUDE_DIR})
foreach(lib cholmod umfpack klu btf amd colamd suitesparseconfig)
  find_library(SUITESPARSE_${lib} ${lib} REQUIRED)
  target_link_libraries(SuiteSparse INTERFACE ${SUITESPARSE_${lib}})
endforeach()
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
target_link_libraries(SuiteSparse INTERFACE ${OPENBLAS_LIBRARY})

# Only the part of PCL that filters clouds (PCL's own CMake package would ask
# for VTK and the rest; pcl_io alone loads 67 libraries into every process).
find_path(PCL_INCLUDE_DIR pcl/point_types.h
          PATH_SUFFIXES pcl-1.13 pcl-1.12 REQUIRED)
add_library(PointClouds INTERFACE)
target_include_directories(PointClouds SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
foreach(lib common filters)
  find_library(PCL_${lib} pcl_${lib} REQUIRED)
  target_link_libraries(PointClouds INTERFACE ${PCL_${lib}})
endforeach()

if(INVSIM_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

# Flags common to every target and to those who link us. Eigen objects are
# aligned to 16 bytes, as in Debian's libraries; memory they allocate is not
# interchangeable (with AVX Eigen brings its own allocator), so none crosses
# into a library that was built with Eigen, and whoever links us is compiled for
# the same instructions. Hidden symbols keep our Eigen functions from taking the
# place of a library's own.
add_library(invsim_flags INTERFACE)
set_target_properties(invsim_flags PROPERTIES EXPORT_NAME flags)
target_compile_definitions(invsim_flags INTERFACE EIGEN_MAX_ALIGN_BYTES=16)
target_compile_features(invsim_flags INTERFACE cxx_std_20)
if(INVSIM_NATIVE)
  target_compile_options(invsim_flags INTERFACE -march=native)
endif()
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
# A program loads only the libraries it uses.
add_link_options(-Wl,--as-needed)
set(INVSIM_WARNINGS -Wall -Wextra -Wshadow -Wno-unused-parameter)
# GCC 12 gives false alarms about Eigen's AVX-512 kernels on small matrices
# (its own intrinsics start from an undefined register) and about
# `"text" + std::string` (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND INVSIM_WARNINGS
       -Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict)
endif()
if(INVSIM_WERROR)
  list(APPEND INVSIM_WARNINGS -Werror)
endif()
set_property(GLOBAL APPEND PROPERTY INVSIM_TARGETS invsim_flags)
