# Tests that run under Node.js, of the modules whose arithmetic decides a result. They are one program, since linking
# one for each would take seconds. They read files of the host. Tests that start threads or processes are excluded.
set(WEB_TEST_MODULES base model search estimate/refine)
set(WEB_TEST_SOURCES)
foreach(module IN LISTS WEB_TEST_MODULES)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${module}/*_test.cc")
  list(FILTER sources EXCLUDE REGEX "_(rate|field)_test\\.cc$")
  list(APPEND WEB_TEST_SOURCES ${sources})
endforeach()
foreach(source IN LISTS WEB_TEST_SOURCES)
  file(STRINGS "${source}" beyond REGEX "_DEATH\\(|_EXIT\\(|std::thread|std::async|fork\\(|float128")
  if(beyond)
    list(REMOVE_ITEM WEB_TEST_SOURCES "${source}")
    message(STATUS "Not under Node.js, for threads, processes or numbers that are not there: ${source}")
  endif()
endforeach()
add_executable(web_tests EXCLUDE_FROM_ALL ${WEB_TEST_SOURCES} synthetic/curves.cc)
target_include_directories(web_tests PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}")
target_compile_definitions(web_tests PRIVATE LYREFIT_DATA_DIR="${PROJECT_SOURCE_DIR}/data" LYREFIT_FIELD_DATA_DIR="")
target_link_libraries(web_tests PRIVATE lyrefit GTest::gmock GTest::gtest GTest::gtest_main fmt::fmt Eigen3::Eigen Boost::boost)
target_precompile_headers(web_tests PRIVATE shared_headers.h)
target_link_options(web_tests PRIVATE -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sEXIT_RUNTIME=1 -O1)
add_test(NAME web/modules COMMAND web_tests)
set_tests_properties(web/modules PROPERTIES TIMEOUT 600)

# The other tests compare with the native command.
if(NOT EXISTS "${LYREFIT_NATIVE}")
  message(STATUS "Neither the page nor its digits are tested: there is no command ${LYREFIT_NATIVE} to compare with")
  return()
endif()

# Compares the results of the page's engine and of the native command for every measurement under data/.
add_test(NAME web/digits COMMAND node --no-experimental-fetch "${PROJECT_SOURCE_DIR}/cmake/web/digits.mjs"
         "ENGINE=$<TARGET_FILE:lyrefit_web>" "APP=${LYREFIT_NATIVE}" "DATA=${PROJECT_SOURCE_DIR}/data")
set_tests_properties(web/digits PROPERTIES TIMEOUT 900)

# Tests the page in a browser, with the packages of tests/pages that setup.sh installs.
find_program(LYREFIT_CHROMIUM NAMES chromium-headless-shell chromium chromium-browser google-chrome
             NO_CMAKE_FIND_ROOT_PATH)
set(PAGES "${CMAKE_CURRENT_BINARY_DIR}/pages")
if(LYREFIT_CHROMIUM AND LYREFIT_PLOTLY AND EXISTS "${PAGES}/node_modules/playwright-core")
  foreach(script browser web_page web_test web_verbs_test)
    configure_file("pages/${script}.mjs" "${PAGES}/${script}.mjs" COPYONLY)
  endforeach()
  add_test(NAME web/page COMMAND node --test "${PAGES}/web_test.mjs" "${PAGES}/web_verbs_test.mjs")
  set_tests_properties(web/page PROPERTIES TIMEOUT 900 ENVIRONMENT
    "PAGE=${PROJECT_BINARY_DIR}/apps/web/lyrefit.html;APP=${LYREFIT_NATIVE};CHROMIUM=${LYREFIT_CHROMIUM};DATA=${PROJECT_SOURCE_DIR}/data;OUT=${PAGES}/out")
else()
  add_test(NAME web/page COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: chromium, Plotly, playwright-core or axe-core missing")
  set_tests_properties(web/page PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED")
endif()
