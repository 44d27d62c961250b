# Ceres as the shared library it also comes as; Debian's own CMake package names
# the static one. That would bring its compiled Eigen functions into our
# programs, under the names of ours, of which the linker keeps one: memory
# allocated by theirs (16 bytes aligned) would be freed by ours (64 bytes), or
# the other way round. Installed with invsim, whose users link the same.
#
#   SharedCeres::SharedCeres
include(FindPackageHandleStandardArgs)

find_path(SharedCeres_INCLUDE_DIR ceres/ceres.h)
set(prefix ${CMAKE_SHARED_LIBRARY_PREFIX})
set(suffix ${CMAKE_SHARED_LIBRARY_SUFFIX})
find_library(SharedCeres_LIBRARY NAMES ${prefix}ceres${suffix})
mark_as_advanced(SharedCeres_INCLUDE_DIR SharedCeres_LIBRARY)
find_package_handle_standard_args(SharedCeres
  REQUIRED_VARS SharedCeres_LIBRARY SharedCeres_INCLUDE_DIR)

if(SharedCeres_FOUND AND NOT TARGET SharedCeres::SharedCeres)
  add_library(SharedCeres::SharedCeres SHARED IMPORTED)
  set_target_properties(SharedCeres::SharedCeres PROPERTIES
    IMPORTED_LOCATION "${SharedCeres_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SharedCeres_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "Eigen3::Eigen;glog::glog")
endif()
