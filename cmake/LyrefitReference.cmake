# The target `reference`: reference pages of all installed headers (cmake/reference). It needs doxygen and Python 3. The
# test of this name fails if a public header leaves a declaration undocumented or documents it wrongly.
find_program(DOXYGEN doxygen)
find_program(LYREFIT_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)  # prefers Debian's Python
find_program(LYREFIT_PYTHON NAMES python3)
mark_as_advanced(DOXYGEN LYREFIT_PYTHON)
if(NOT DOXYGEN OR NOT LYREFIT_PYTHON)
  message(STATUS "No reference pages: they need doxygen and python3")
  if(LYREFIT_BUILD_TESTS)
    add_test(NAME reference COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: doxygen or python3 missing")
    set_tests_properties(reference PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED")
  endif()
  return()
endif()

set(LYREFIT_REFERENCE_DIR "${PROJECT_BINARY_DIR}/reference")
set(REFERENCE_PAGES "${PROJECT_SOURCE_DIR}/README.md")
file(GLOB_RECURSE pages CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/lib/lyrefit/*/README.md")
list(APPEND REFERENCE_PAGES ${pages})
set(REFERENCE_HEADERS ${LYREFIT_PUBLIC_HEADERS})
list(FILTER REFERENCE_HEADERS INCLUDE REGEX "\\.h$")
list(JOIN REFERENCE_PAGES "\n" pages)
list(JOIN REFERENCE_HEADERS "\n" headers)
file(CONFIGURE OUTPUT "${LYREFIT_REFERENCE_DIR}/files.txt" CONTENT "${pages}\n${headers}\n")
configure_file(cmake/reference/Doxyfile.in "${LYREFIT_REFERENCE_DIR}/Doxyfile" @ONLY)
add_custom_target(reference
  COMMAND "${LYREFIT_PYTHON}" -B "${PROJECT_SOURCE_DIR}/cmake/reference/prepare.py" --root "${PROJECT_SOURCE_DIR}"
          --out "${LYREFIT_REFERENCE_DIR}/input" "${LYREFIT_REFERENCE_DIR}/files.txt"
  COMMAND "${CMAKE_COMMAND}" -E rm -rf "${LYREFIT_REFERENCE_DIR}/html"
  COMMAND "${DOXYGEN}" "${LYREFIT_REFERENCE_DIR}/Doxyfile"
  COMMAND "${CMAKE_COMMAND}" -E echo "${LYREFIT_REFERENCE_DIR}/html/index.html"
  COMMENT "Reference pages" VERBATIM)

if(LYREFIT_BUILD_TESTS)
  add_test(NAME reference COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target reference)
  set_tests_properties(reference PROPERTIES RESOURCE_LOCK reference)  # site/build makes it too
  add_test(NAME reference_sees_what_has_no_words COMMAND ${CMAKE_COMMAND} -DPYTHON=${LYREFIT_PYTHON} -DDOXYGEN=${DOXYGEN}
           -DREFERENCE=${PROJECT_SOURCE_DIR}/cmake/reference -DWORK=${PROJECT_BINARY_DIR}/tests/project/reference
           -P ${PROJECT_SOURCE_DIR}/tests/project/reference_test.cmake)
endif()
