# Everything invsim links, found once. Versions and licences are in
# third_party_notes.md.
set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
set(THREADS_PREFER_PTHREAD_FLAG ON)

# What the layers link; who links the layers needs the same.
set(INVSIM_DEPENDENCIES Threads Eigen3 glog TBB SharedCeres
                        nlohmann_json tomlplusplus ZLIB TinyGLTF embree
                        SparseSolvers PointClouds)
foreach(dependency ${INVSIM_DEPENDENCIES})
  find_package(${dependency} REQUIRED)
endforeach()
if(NOT PointClouds_INCLUDE_DIR)
  message(FATAL_ERROR "The headers of PCL are missing; run ./run setup")
endif()
if(INVSIM_LIBFUZZER)
  # toml++ compiled with us, so that the fuzzer sees into it.
  set_property(TARGET tomlplusplus::tomlplusplus PROPERTY
               INTERFACE_COMPILE_OPTIONS -DTOML_HEADER_ONLY=1)
endif()
if(INVSIM_BUILD_APPS)
  find_package(CLI11 REQUIRED)
endif()
if(INVSIM_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

# Flags common to every target and to those who link us. Eigen's memory and
# objects are aligned for the largest vectors there are: loops over memory
# aligned to less begin one by one, up to where it is aligned, which changes
# from run to run and with it the last bits. Debian's libraries align to 16
# bytes and allocate otherwise, so nothing of Eigen crosses into a library that
# was built with it, and all of those are shared: our symbols are hidden and
# theirs are their own, so that neither's Eigen functions take the place of the
# other's.
add_library(invsim_flags INTERFACE)
set_target_properties(invsim_flags PROPERTIES EXPORT_NAME flags)
target_compile_definitions(invsim_flags INTERFACE EIGEN_MAX_ALIGN_BYTES=64)
target_compile_features(invsim_flags INTERFACE cxx_std_20)
# For the same reason no loop is contracted to fused operations in one part and
# not in another. (Eigen's matrix products name their fused operations
# themselves.)
target_compile_options(invsim_flags INTERFACE -ffp-contract=off)
if(INVSIM_NATIVE)
  target_compile_options(invsim_flags INTERFACE -march=native)
endif()
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
# A program loads only the libraries it uses.
add_link_options(-Wl,--as-needed)
set(INVSIM_WARNINGS -Wall -Wextra -Wshadow -Wno-unused-parameter)
# GCC 12 gives false alarms about Eigen's AVX-512 kernels on small matrices
# (its own intrinsics start from an undefined register, its bug 105593; on some
# processors and with sanitizers they are even called uninitialized for sure)
# and about `"text" + std::string` (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND INVSIM_WARNINGS
       -Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict)
  if(INVSIM_NATIVE OR CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    list(APPEND INVSIM_WARNINGS -Wno-uninitialized)
  endif()
endif()
# Several sources in one: what a source's private class holds of its anonymous
# namespace then looks as if it came from a header.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND INVSIM_WARNINGS -Wno-subobject-linkage)
endif()
if(INVSIM_WERROR)
  list(APPEND INVSIM_WARNINGS -Werror)
endif()
set_property(GLOBAL APPEND PROPERTY INVSIM_TARGETS invsim_flags)
