# `cmake --install` and the package that find_package(invsim) finds. Tested by
# tests/package.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/invsim)
get_property(targets GLOBAL PROPERTY INVSIM_TARGETS)
install(TARGETS ${targets} EXPORT invsimTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/invsim DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT invsimTargets NAMESPACE invsim:: DESTINATION ${package_dir})

configure_package_config_file(cmake/invsimConfig.cmake.in invsimConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(invsimConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/invsimConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/invsimConfigVersion.cmake
              cmake/FindSharedCeres.cmake
              cmake/FindSparseSolvers.cmake
              cmake/FindPointClouds.cmake
        DESTINATION ${package_dir})
install(FILES LICENSE third_party_notes.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
