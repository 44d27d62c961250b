# The part of PCL that filters clouds (PCL's own CMake package would ask for VTK
# and the rest; pcl_io alone loads 67 libraries into every process). Installed
# with invsim, whose users link the static libraries; they need no PCL header, so
# a missing one is no error here.
#
#   PointClouds::PointClouds
#
# Debian puts the headers and every library's plain .so name into libpcl-dev,
# which depends on 600 further packages (VTK, Qt, OpenMPI ...). `./run setup`
# therefore installs the libraries only, found here under their full names, and
# unpacks the headers alone into build/pcl.
include(FindPackageHandleStandardArgs)

set(PointClouds_VERSION 1.13)
find_path(PointClouds_INCLUDE_DIR pcl/point_types.h
          HINTS ${CMAKE_SOURCE_DIR}/build/pcl/usr/include
          PATH_SUFFIXES pcl-${PointClouds_VERSION})
set(libraries "")
set(variables "")
foreach(name common filters)
  find_library(PointClouds_${name}_LIBRARY
               NAMES pcl_${name} libpcl_${name}.so.${PointClouds_VERSION})
  mark_as_advanced(PointClouds_${name}_LIBRARY)
  list(APPEND libraries ${PointClouds_${name}_LIBRARY})
  list(APPEND variables PointClouds_${name}_LIBRARY)
endforeach()
mark_as_advanced(PointClouds_INCLUDE_DIR)
find_package_handle_standard_args(PointClouds REQUIRED_VARS ${variables})

if(PointClouds_FOUND AND NOT TARGET PointClouds::PointClouds)
  add_library(PointClouds::PointClouds INTERFACE IMPORTED)
  set_target_properties(PointClouds::PointClouds PROPERTIES
    INTERFACE_LINK_LIBRARIES "${libraries}")
  if(PointClouds_INCLUDE_DIR)
    target_include_directories(PointClouds::PointClouds SYSTEM INTERFACE
                               ${PointClouds_INCLUDE_DIR})
  endif()
endif()
