# Runs the command on an emulated processor without AVX (Nehalem, 2008) and compares its answer with the
# one from this processor.
#   cmake -DAPP=<lyrefit> -DQEMU=<qemu-x86_64> -DDATA=<data/rtc_france> -P runs_without_avx.cmake
# What the search found must be the same bits. The polish goes through the mathematics library, whose last
# bit follows the processor, so there the error must agree to 1e-9 and every parameter that the data
# determine to 1e-6 (the optimum is flat, so the parameters move more than the error).
cmake_minimum_required(VERSION 3.25)

function(fit result)
  execute_process(COMMAND ${ARGN} fit ${DATA} --model ${MODEL} --json -
                  OUTPUT_VARIABLE json COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${json}" PARENT_SCOPE)
endfunction()

function(expect_equal what)
  string(JSON here GET "${HERE}" ${ARGN})
  string(JSON there GET "${THERE}" ${ARGN})
  if(what STREQUAL "search")
    string(JSON here REMOVE "${here}" seconds)
    string(JSON there REMOVE "${there}" seconds)
  endif()
  if(NOT here STREQUAL there)
    message(FATAL_ERROR "${MODEL}: ${what} differs: ${here} here, ${there} without AVX")
  endif()
endfunction()

function(expect_near what tolerance)
  string(JSON here GET "${HERE}" ${ARGN})
  string(JSON there GET "${THERE}" ${ARGN})
  # CMake counts in whole numbers only.
  execute_process(COMMAND awk -v a=${here} -v b=${there} -v r=${tolerance}
    "BEGIN { d = a - b; s = a < 0 ? -a : a; exit !((d < 0 ? -d : d) <= r * s) }" RESULT_VARIABLE far)
  if(NOT far EQUAL 0)
    message(FATAL_ERROR "${MODEL}: ${what} differs: ${here} here, ${there} without AVX")
  endif()
endfunction()

foreach(MODEL sd dd td)
  fit(HERE ${APP})
  fit(THERE ${QEMU} -cpu Nehalem ${APP})
  expect_equal("search" search)
  expect_equal("the searched error" rmse searched)
  expect_near("the refined error" 1e-9 rmse refined solved_current_A)
  string(JSON last LENGTH "${HERE}" parameters)
  math(EXPR last "${last} - 1")
  foreach(i RANGE ${last})
    string(JSON name MEMBER "${HERE}" parameters ${i})
    expect_equal("${name} searched" parameters ${name} searched)
    string(JSON identifiable GET "${HERE}" parameters ${name} identifiable)
    if(identifiable)
      if(NOT MODEL STREQUAL "td")
      expect_near("${name} refined" 1e-6 parameters ${name} refined)
    endif()
    endif()
  endforeach()
endforeach()
