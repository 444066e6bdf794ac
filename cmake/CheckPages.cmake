# Test of the names in backticks on the pages README.md of the modules and their folders, and on those of the decisions. Every file
# named must exist. Every word with an underscore must be a file's name without its ending, or occur in the sources.
#   cmake -DROOT=<folder with lib/, apps/ and tests/> -P CheckPages.cmake
# Lists every name that does not exist and fails if there is one.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE FILES RELATIVE "${ROOT}" "${ROOT}/lib/*" "${ROOT}/apps/*" "${ROOT}/tests/*" "${ROOT}/cmake/*"
     "${ROOT}/data/*")
list(JOIN FILES "\n/" PATHS)
set(PATHS "/${PATHS}\n")
set(SOURCES "")
foreach(file IN LISTS FILES)
  if(file MATCHES "\\.(h|cc|py|js)$|CMakeLists\\.txt$")
    file(READ "${ROOT}/${file}" text)
    string(APPEND SOURCES "${text}")
  endif()
endforeach()

# Functions of pvlib, which are not checked.
set(FOREIGN ivtools.utils.astm_e1036)

set(STALE "")
file(GLOB PAGES "${ROOT}/lib/lyrefit/*/README.md" "${ROOT}/lib/lyrefit/*/*/README.md" "${ROOT}/lib/decisions/*.md")
foreach(page IN LISTS PAGES)
  file(READ "${page}" text)
  string(REPLACE ";" " " text "${text}")
  string(REGEX MATCHALL "`[a-z0-9_/][a-z0-9_./]+`" names "${text}")
  list(REMOVE_DUPLICATES names)
  foreach(name IN LISTS names)
    string(REPLACE "`" "" name "${name}")
    if(NOT name MATCHES "_|\\.(h|cc|md|sh|cmake|csv)$" OR name IN_LIST FOREIGN)
      continue()
    endif()
    string(REGEX REPLACE "^build/tests/|^\\./|/$" "" name "${name}")
    if(name MATCHES "^([a-z]+)_(rate_test|field_test|test|study)$")  # a program of tests/CMakeLists.txt
      file(GLOB made "${ROOT}/tests/${CMAKE_MATCH_1}/*_${CMAKE_MATCH_2}.cc"
           "${ROOT}/tests/*/${CMAKE_MATCH_1}/*_${CMAKE_MATCH_2}.cc")
      if(made)
        continue()
      endif()
    endif()
    string(FIND "${PATHS}" "/${name}\n" whole)
    string(FIND "${PATHS}" "/${name}." stem)
    string(FIND "${PATHS}" "/${name}/" folder)
    set(word -1)
    if(NOT name MATCHES "\\.(h|cc|md|sh|cmake|csv)$")
      string(REGEX REPLACE "^.*\\." "" last "${name}")
      string(FIND "${SOURCES}" "${last}" word)
    endif()
    if(whole LESS 0 AND stem LESS 0 AND folder LESS 0 AND word LESS 0)
      file(RELATIVE_PATH where "${ROOT}" "${page}")
      string(APPEND STALE "${where} names ${name}, which is not there\n")
    endif()
  endforeach()
endforeach()
if(STALE)
  message(FATAL_ERROR "${STALE}")
endif()
