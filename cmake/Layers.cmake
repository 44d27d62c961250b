# invsim_layer(NAME PUBLIC ... PRIVATE ...): the static library invsim_NAME
# from src/NAME/**.cpp, with headers in include/invsim/NAME. A layer that has
# no source yet is header-only.
function(invsim_layer name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
       ${CMAKE_CURRENT_SOURCE_DIR}/src/${name}/*.cpp)
  set(target invsim_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE})
    target_compile_options(${target} PRIVATE ${INVSIM_WARNINGS})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(invsim::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} ${scope} ${ARG_PUBLIC} invsim_flags)
  set_property(GLOBAL APPEND PROPERTY INVSIM_TARGETS ${target})
endfunction()

# invsim_tests(NAME SOURCES ... LIBRARIES ...): the test program NAME_tests;
# CTest name NAME/Case.Test, label NAME.
function(invsim_tests name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(target ${name}_tests)
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_options(${target} PRIVATE ${INVSIM_WARNINGS})
  target_link_libraries(${target} PRIVATE ${ARG_LIBRARIES} invsim_test_main)
  gtest_discover_tests(${target} TEST_PREFIX "${name}/"
                       DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS ${name} TIMEOUT ${INVSIM_TEST_SECONDS}
                                  ENVIRONMENT OPENBLAS_NUM_THREADS=1)
endfunction()
