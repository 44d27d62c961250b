# Installs BUILD_DIR to a new prefix under WORK_DIR, and configures, builds and
# runs the project beside this file against it. Fails at the first step that
# does; TOOLCHAIN is a list of -D options that the two builds must share.
cmake_minimum_required(VERSION 3.25)
set(prefix ${WORK_DIR}/prefix)
set(build ${WORK_DIR}/build)
file(REMOVE_RECURSE ${WORK_DIR})

function(step)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
step(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
step(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${build} -G Ninja
     -DCMAKE_PREFIX_PATH=${prefix} ${TOOLCHAIN})
step(${CMAKE_COMMAND} --build ${build})
step(${build}/consumer)
