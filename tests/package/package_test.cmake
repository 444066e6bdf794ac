# Installs lyrefit into a fresh prefix as its packages do, then uses it in each of the ways that its users have:
# find_package of the static archive and of the shared library, pkg-config with the bare compiler, add_subdirectory,
# the command. Nothing of lyrefit is compiled again: all are linked with what the build has.
#   cmake -DBUILD=<lyrefit's build folder> -DWORK=<scratch folder> -DSOURCE=<lyrefit's tree> -DCONFIG=Release
#         -DCOMPILER=<c++> -DGENERATOR=<generator> -DLIBDIR=lib -DNM=<nm> -P package_test.cmake
cmake_minimum_required(VERSION 3.25)
set(DATA "${SOURCE}/data/rtc_france")
set(PREFIX "${WORK}/prefix")
set(HERE "${CMAKE_CURRENT_LIST_DIR}")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK}")
foreach(component runtime dev command)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --config ${CONFIG} --component ${component})
endforeach()

# Without components, what is laid down is the static archive and the command, and no file of packages.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/plain --config ${CONFIG})
file(GLOB_RECURSE laid RELATIVE "${WORK}/plain" "${WORK}/plain/*")
foreach(wanted bin/lyrefit include/lyrefit/lyrefit.h ${LIBDIR}/liblyrefit.a ${LIBDIR}/pkgconfig/lyrefit.pc)
  if(NOT wanted IN_LIST laid)
    message(FATAL_ERROR "a plain installation has no ${wanted}")
  endif()
endforeach()
list(FILTER laid INCLUDE REGEX "liblyrefit[.]so|completion|man1|shared")
if(laid)
  message(FATAL_ERROR "a plain installation has ${laid}")
endif()
run(${WORK}/plain/bin/lyrefit --version)

run(${CMAKE_COMMAND} -S ${HERE} -B ${WORK}/consumer -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${WORK}/consumer --config ${CONFIG})
run(${WORK}/consumer/consumer ${DATA})
run(${WORK}/consumer/study ${DATA})
run(${WORK}/consumer/batch ${DATA}/../plant/strings.csv ${WORK}/results)
run(${WORK}/consumer/across ${WORK}/none)

# The core alone: what it is laid down with, what it links, what is in it.
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/core_prefix --config ${CONFIG} --component core)
run(${CMAKE_COMMAND} -S ${HERE}/core -B ${WORK}/core -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${WORK}/core_prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${WORK}/core --config ${CONFIG})
run(${WORK}/core/core)
execute_process(COMMAND ${NM} -C ${WORK}/core_prefix/${LIBDIR}/liblyrefit_core.a OUTPUT_VARIABLE symbols ERROR_QUIET
                COMMAND_ERROR_IS_FATAL ANY)
foreach(foreign "nlohmann" " csv_" " deflate" " inflate" "lyrefit::ReadCurve" "lyrefit::DrawPage" "lyrefit::DrawText")
  if(symbols MATCHES "${foreign}")
    message(FATAL_ERROR "the archive of the core has ${foreign}")
  endif()
endforeach()
if(NOT symbols MATCHES "lyrefit::Fit\\(")
  message(FATAL_ERROR "the archive of the core has no lyrefit::Fit")
endif()
file(SIZE ${WORK}/core_prefix/${LIBDIR}/liblyrefit_core.a core_size)
file(SIZE ${PREFIX}/${LIBDIR}/liblyrefit.a whole_size)
file(SIZE ${WORK}/core/core core_program)
file(SIZE ${WORK}/consumer/consumer whole_program)
message(STATUS "bytes: archive of the core ${core_size}, of the whole ${whole_size}; a program of the core ${core_program}, of the whole ${whole_program}")

# pkg-config: once compiled, linked with the shared library and with the archive.
find_program(PKG_CONFIG NAMES pkgconf pkg-config)
function(flags out)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${PREFIX}/${LIBDIR}/pkgconfig" ${PKG_CONFIG} ${ARGN}
                          lyrefit
                  OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(said UNIX_COMMAND "${said}")
  set(${out} ${said} PARENT_SCOPE)
endfunction()
if(PKG_CONFIG)
  flags(compile --cflags)
  flags(shared --libs)
  flags(static --libs --static)
  run(${COMPILER} -std=c++17 ${compile} -c ${HERE}/own_effect.cc -o ${WORK}/own_effect.o)
  run(${COMPILER} ${WORK}/own_effect.o -o ${WORK}/own_shared ${shared} -Wl,-rpath,${PREFIX}/${LIBDIR})
  list(TRANSFORM static REPLACE "^-llyrefit$" "-l:liblyrefit.a")
  run(${COMPILER} ${WORK}/own_effect.o -o ${WORK}/own_static ${static})
  run(${WORK}/own_shared WORKING_DIRECTORY ${SOURCE})
  run(${WORK}/own_static WORKING_DIRECTORY ${SOURCE})
else()
  message(NOTICE "SKIPPED: pkg-config is not tried, since it is not there (Debian: pkgconf)")
endif()

# The command on the shared library needs nothing but that, and says to the byte what the one on the archive says; only
# the time of the clock is its own.
function(answer command out)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${PREFIX}/${LIBDIR}" ${command} ${ARGN} --json -
                  OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY WORKING_DIRECTORY ${SOURCE})
  string(REGEX REPLACE "\"seconds\": [-+.0-9e]+" "\"seconds\": 0" said "${said}")
  set(${out} "${said}" PARENT_SCOPE)
endfunction()
foreach(task "fit;data/rtc_france;--model;dd" "diagnose;data/formats/head_tracer.csv" "certify;data/rtc_france"
             "compare;data/rtc_france;--runs;2;--iterations;50")
  answer(${PREFIX}/bin/lyrefit on_shared ${task})
  answer(${WORK}/plain/bin/lyrefit on_archive ${task})
  string(LENGTH "${on_shared}" length)
  if(NOT on_shared STREQUAL on_archive OR length LESS 500)
    message(FATAL_ERROR "the command on the shared library says something else of ${task}")
  endif()
  message(STATUS "the same ${length} bytes of JSON: ${task}")
endforeach()
run(${CMAKE_COMMAND} -DLIBRARY=${PREFIX}/${LIBDIR}/liblyrefit.so -DHEADERS=${PREFIX}/include -DPLANT=${SOURCE}/apps/plant -DNM=${NM}
    -P ${HERE}/symbols.cmake)

# A part of another project. Its own file is compiled, and linked by the line that its build has for it, for which the
# archives of this build take the place of those it would make.
if(GENERATOR STREQUAL "Ninja")
  set(within ${WORK}/within)
  run(${CMAKE_COMMAND} -S ${HERE}/within -B ${within} -G Ninja -DLYREFIT=${SOURCE} -DCMAKE_CXX_COMPILER=${COMPILER})
  run(${CMAKE_COMMAND} --build ${within} --target within_main)
  file(GLOB archives "${BUILD}/lib/liblyrefit_*.a")
  file(COPY ${archives} DESTINATION "${within}/lyrefit/lib")
  execute_process(COMMAND ninja -C ${within} -t commands within OUTPUT_VARIABLE commands COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "[^\n]*-o within [^\n]*" link "${commands}")
  run(sh -c "${link}" WORKING_DIRECTORY ${within})
  run(${within}/within ${DATA})
  run(${CMAKE_COMMAND} --install ${within} --prefix ${within}/prefix)
  file(GLOB_RECURSE laid RELATIVE "${within}/prefix" "${within}/prefix/*")
  if(NOT laid STREQUAL "bin/within")
    message(FATAL_ERROR "a project with lyrefit in it installs ${laid}")
  endif()
endif()
