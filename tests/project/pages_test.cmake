# Shows that CheckPages.cmake sees what it is there to see: a small tree with one page.
#   cmake -DCHECKER=<CheckPages.cmake> -DWORK=<scratch folder> -P pages_test.cmake
cmake_minimum_required(VERSION 3.25)

set(FAILURES 0)
# `expected` is part of what the checker must say; "" where the page is right. A third argument is the path of the page.
function(expect page expected)
  set(place lib/lyrefit/estimate/fit/README.md)
  if(ARGC GREATER 2)
    set(place "${ARGV2}")
  endif()
  file(REMOVE_RECURSE "${WORK}")
  file(WRITE "${WORK}/lib/lyrefit/estimate/fit/fit_job.cc" "int HoldOut();  // held_out is a word of the source\n")
  file(WRITE "${WORK}/${place}" "# fit\n\n${page}\n")
  file(WRITE "${WORK}/tests/estimate/fit/usable_rate_test.cc" "")
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECKER}
                  RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${expected}" found)
  if((expected STREQUAL "" AND NOT code EQUAL 0) OR
     (NOT expected STREQUAL "" AND (code EQUAL 0 OR found LESS 0)))
    message(NOTICE "${page}: expected '${expected}', got ${code}: ${said}")
    math(EXPR FAILURES "${FAILURES} + 1")
  endif()
  set(FAILURES ${FAILURES} PARENT_SCOPE)
endfunction()

expect("`fit_job`, `fit_job.cc`, `lib/lyrefit/estimate/fit/fit_job.cc`, `held_out`, `fit_rate_test`, `plain`, `.cc`" "")
expect("`fit_jobs`" "lib/lyrefit/estimate/fit/README.md names fit_jobs, which is not there")
expect("`fit_jobs`" "lib/decisions/01-fit.md names fit_jobs, which is not there" lib/decisions/01-fit.md)
expect("`fit_job.h`" "names fit_job.h, which is not there")
expect("`lib/lyrefit/model/fit_job.cc`" "names lib/lyrefit/model/fit_job.cc, which is not there")
expect("`fit_field_test`" "names fit_field_test, which is not there")

file(REMOVE_RECURSE "${WORK}")
if(FAILURES)
  message(FATAL_ERROR "${FAILURES} of the pages were judged wrongly")
endif()
