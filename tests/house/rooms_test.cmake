# Shows that CheckRooms.cmake sees what it is there to see: small trees with one include each.
#   cmake -DCHECKER=<CheckRooms.cmake> -DWORK=<scratch folder> -P rooms_test.cmake
cmake_minimum_required(VERSION 3.25)

set(FAILURES 0)
# `expected` is part of what the checker must say; "" where the include is allowed.
function(expect file include expected)
  file(REMOVE_RECURSE "${WORK}")
  file(WRITE "${WORK}/${file}" "// #include <iostream> in a comment does not count\n${include}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECKER}
                  RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${expected}" found)
  if((expected STREQUAL "" AND NOT code EQUAL 0) OR
     (NOT expected STREQUAL "" AND (code EQUAL 0 OR found LESS 0)))
    message(NOTICE "${file} with ${include}: expected '${expected}', got ${code}: ${said}")
    math(EXPR FAILURES "${FAILURES} + 1")
  endif()
  set(FAILURES ${FAILURES} PARENT_SCOPE)
endfunction()

expect(lib/lyrefit/fit/a.cc "#include \"lyrefit/refine/refine.h\"" "")
expect(lib/lyrefit/refine/solve.cc "#include <ceres/ceres.h>" "")
expect(lib/lyrefit/report/a.cc "#include <fmt/format.h>" "")
expect(lib/lyrefit/study/report/a.cc "#include \"lyrefit/report/plot.h\"" "")
expect(lib/lyrefit/lyrefit.h "#include \"lyrefit/report/plot.h\"" "")
expect(apps/lyrefit/main.cc "#include <iostream>" "")
expect(apps/lyrefit/main.cc "#include \"flags.h\"" "")

expect(lib/lyrefit/curve/a.h "#include \"lyrefit/law/term.h\"" "room curve must not include room law")
expect(lib/lyrefit/search/a.cc "#include \"lyrefit/curve/iv_curve.h\"" "room search must not include room curve")
expect(lib/lyrefit/law/a.cc "  #  include <lyrefit/fit/fit.h>" "room law must not include room fit")
expect(lib/lyrefit/report/a.cc "#include \"lyrefit/refine/refine.h\"" "room report must not include room refine")
expect(lib/lyrefit/report/a.cc "#include \"lyrefit/study/report/documents.h\"" "room report must not include room study")
expect(lib/lyrefit/study/report/a.cc "#include \"lyrefit/diagnose/diagnose.h\"" "room study must not include room diagnose")
expect(lib/lyrefit/lyrefit.h "#include \"lyrefit/study/compare.h\"" "the core knows nothing of the studies")
expect(lib/lyrefit/study.h "#include \"lyrefit/study/compare.h\"" "")
expect(lib/lyrefit/fit/a.cc "#include \"../report/plot.h\"" "includes start with")
expect(lib/lyrefit/fit/a.cc "#include \"lyrefit/lyrefit.h\"" "which includes every room")
expect(lib/lyrefit/refine/a.cc "#include <ceres/jet.h>" "only refine/solve.cc and refine/least_squares.cc include Ceres")
expect(apps/lyrefit/main.cc "#include <ceres/ceres.h>" "only refine/solve.cc and refine/least_squares.cc include Ceres")
expect(lib/lyrefit/base/a.h "#include <iostream>" "the library prints nothing")
expect(lib/lyrefit/report/a.cc "#include <CLI/CLI.hpp>" "without the app's dependencies")
expect(lib/lyrefit/attic/a.cc "#include <cmath>" "is no room of the house")

file(REMOVE_RECURSE "${WORK}")
if(FAILURES)
  message(FATAL_ERROR "${FAILURES} of the trees were judged wrongly")
endif()
