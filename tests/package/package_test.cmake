# Installs lyrefit into a fresh prefix, then builds and runs the project beside this file against it.
#   cmake -DBUILD=<lyrefit's build folder> -DWORK=<scratch folder> -DDATA=<curve folder> -DCONFIG=Release
#         -DCOMPILER=<c++> -DGENERATOR=<generator> -P package_test.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --config ${CONFIG})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/consumer -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${WORK}/consumer --config ${CONFIG})
run(${WORK}/consumer/consumer ${DATA})
run(${WORK}/consumer/study ${DATA})
run(${WORK}/consumer/fleet ${DATA}/../plant/strings.csv ${WORK}/results)
run(${WORK}/consumer/own_effect WORKING_DIRECTORY ${DATA}/../..)
if(EXISTS "${WORK}/prefix/bin/lyrefit")
  run(${WORK}/prefix/bin/lyrefit --version)
endif()
