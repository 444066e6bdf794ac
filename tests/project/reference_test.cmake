# The reference must be refused where a public header leaves something without words, and only there.
#   cmake -DPYTHON=<python3> -DDOXYGEN=<doxygen> -DREFERENCE=<cmake/reference> -DWORK=<scratch folder>
#         -P reference_test.cmake
cmake_minimum_required(VERSION 3.25)

# Makes the pages of one header whose text is `text`; sets `result` to what doxygen says, empty where it has nothing
# to say, and `filtered` to what it was given.
function(pages_of text)
  file(REMOVE_RECURSE "${WORK}")
  file(WRITE "${WORK}/lib/lyrefit/estimate/fit/made.h" "${text}")
  file(WRITE "${WORK}/README.md" "# made\n\nA page.\n")
  file(WRITE "${WORK}/lib/lyrefit/estimate/fit/README.md" "# fit\n\nA module.\n")
  file(WRITE "${WORK}/files.txt" "${WORK}/README.md\n${WORK}/lib/lyrefit/estimate/fit/README.md\n${WORK}/lib/lyrefit/estimate/fit/made.h\n")
  execute_process(COMMAND ${PYTHON} -B ${REFERENCE}/prepare.py --root ${WORK} --out ${WORK}/input ${WORK}/files.txt
                  COMMAND_ERROR_IS_FATAL ANY)
  set(PROJECT_SOURCE_DIR "${REFERENCE}/../..")
  set(LYREFIT_REFERENCE_DIR "${WORK}")
  configure_file("${REFERENCE}/Doxyfile.in" "${WORK}/Doxyfile" @ONLY)
  execute_process(COMMAND ${DOXYGEN} ${WORK}/Doxyfile ERROR_VARIABLE said RESULT_VARIABLE code)
  file(READ "${WORK}/input/lib/lyrefit/estimate/fit/made.h" filtered)
  if(said STREQUAL "" AND NOT code EQUAL 0)
    message(FATAL_ERROR "doxygen fails and does not say why")
  endif()
  set(result "${said}" PARENT_SCOPE)
  set(filtered "${filtered}" PARENT_SCOPE)
endfunction()

function(expect text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "expected ${pattern} in\n${text}")
  endif()
endfunction()

set(before "#pragma once\n\nnamespace lyrefit {\n\n")
set(after "\n}  // namespace lyrefit\n")

pages_of("${before}// What it is.\nstruct Synthetic {\n  double first_V = 1;  // of one\n  double second_V = 2;\n};\n${after}")
if(NOT result STREQUAL "")
  message(FATAL_ERROR "doxygen complains of what has words:\n${result}")
endif()
expect("${filtered}" "/// in volt\n  double second_V")
pages_of("${before}struct Synthetic {\n  int first = 1;  // of one\n};\n${after}")
expect("${result}" "Synthetic is not documented")
pages_of("${before}// What it is.\nstruct Synthetic {\n  int first = 1;\n};\n${after}")
expect("${result}" "first .variable. of struct lyrefit::Synthetic is not documented")
pages_of("${before}// What it does.\nvoid Do();\n\nvoid Leave();\n${after}")
expect("${result}" "Leave.. .function. .* is not documented")

# A comment holds on for functions below it, for fields of the same type and for what follows its type; not for others.
pages_of("${before}// Two numbers.\nstruct Synthetic {\n  // Ends of the range.\n  double low = 0;\n  double most = 1;\n  int left = 0;\n};\nMade Make();\n${after}")
expect("${result}" "left .variable. of struct")
expect("${filtered}" "/// Ends of the range.\n  double most")
expect("${filtered}" "/// Two numbers.\nMade Make")
if(result MATCHES "most|Make ")
  message(FATAL_ERROR "a comment does not hold on:\n${result}")
endif()
