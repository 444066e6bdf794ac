# The house rules, as a test: a room includes only rooms above it, and the command only what is installed.
#   cmake -DROOT=<folder with lib/ and apps/> -P CheckRooms.cmake
# Lists every include that breaks a rule and fails if there is one.
cmake_minimum_required(VERSION 3.25)

# room -> the rooms of lib/lyrefit that its files may include, besides itself
set(ALLOWED_base)
set(ALLOWED_curve base)
set(ALLOWED_law base curve)
set(ALLOWED_search base)  # knows no photovoltaics
set(ALLOWED_refine base curve law)
set(ALLOWED_certify base curve law refine)
set(ALLOWED_fit base curve law search refine certify effects)
set(ALLOWED_family base curve law search refine fit effects)
set(ALLOWED_effects base curve law)  # knows no fitting
set(ALLOWED_diagnose base curve law search refine fit family effects)
set(ALLOWED_translate base curve law fit family effects diagnose)
set(ALLOWED_report base curve law search certify fit family diagnose translate)  # computes nothing
# A library of its own with its writers in study/report; what the core writes knows nothing of it.
set(ALLOWED_study base curve law search refine certify fit family effects report)
# Another: many curves, their rows and their page.
set(ALLOWED_fleet base curve law fit effects family diagnose translate report)
set(ROOMS base curve law search refine certify effects fit family diagnose translate report study fleet)

set(PUBLIC)  # the headers that are installed
if(EXISTS "${ROOT}/cmake/LyrefitInstall.cmake")
  file(STRINGS "${ROOT}/cmake/LyrefitInstall.cmake" PUBLIC REGEX "^  [a-z_/]+\\.h\\)?$")
  list(TRANSFORM PUBLIC REPLACE "[ )]" "")
endif()

set(BROKEN 0)
macro(complain text)
  message(NOTICE "${FILE}: ${text}")
  math(EXPR BROKEN "${BROKEN} + 1")
endmacro()

# An include among the project's own headers, `quoted` as it stands between the quotation marks.
function(check_own_include room quoted)
  if(NOT quoted MATCHES "^lyrefit/(.+)$")
    complain("includes \"${quoted}\"; inside lib/ includes start with \"lyrefit/\"")
  elseif(CMAKE_MATCH_1 MATCHES "^([^/]+)/")
    set(other "${CMAKE_MATCH_1}")
    if(NOT other STREQUAL room AND NOT other IN_LIST ALLOWED_${room})
      complain("room ${room} must not include room ${other} (\"${quoted}\")")
    endif()
  else()
    complain("room ${room} must not include \"${quoted}\", which includes every room")
  endif()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

# An include of the command among the project's headers: what LyrefitInstall.cmake lists, and a macro for brevity.
function(check_public_include header)
  if(header MATCHES "^lyrefit/(.+)$" AND PUBLIC AND NOT header STREQUAL "lyrefit/base/try.h"
     AND NOT CMAKE_MATCH_1 IN_LIST PUBLIC)
    complain("the command must not include the closed header \"${header}\"")
  endif()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

function(check_file room)
  file(STRINGS "${ROOT}/${FILE}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)[>\"]")
      continue()
    endif()
    set(mark "${CMAKE_MATCH_1}")
    set(header "${CMAKE_MATCH_2}")
    if(header MATCHES "^ceres/" AND NOT FILE MATCHES "/refine/(solve|least_squares)\\.cc$")
      complain("only refine/solve.cc and refine/least_squares.cc include Ceres (<${header}>)")
    endif()
    if(room STREQUAL "apps")
      check_public_include("${header}")
      continue()
    endif()
    if(header STREQUAL "iostream")
      complain("the library prints nothing (<iostream>)")
    elseif(header MATCHES "^CLI/")
      complain("the library must build without the app's dependencies (<${header}>)")
    endif()
    if(FILE STREQUAL "lib/lyrefit/lyrefit.h" AND header MATCHES "^lyrefit/(study|fleet)[/.]")
      complain("the core knows nothing of the studies and of fleets (\"${header}\")")
    endif()
    if(room IN_LIST ROOMS AND (mark STREQUAL "\"" OR header MATCHES "^lyrefit/"))
      check_own_include(${room} "${header}")
    endif()
  endforeach()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/lib/*.h" "${ROOT}/lib/*.cc"
     "${ROOT}/apps/*.h" "${ROOT}/apps/*.cc")
foreach(FILE IN LISTS files)
  if(FILE MATCHES "^apps/")
    check_file(apps)
  elseif(FILE MATCHES "^lib/lyrefit/([^/]+)/")
    set(room "${CMAKE_MATCH_1}")
    if(NOT room IN_LIST ROOMS)
      complain("lib/lyrefit/${room} is no room of the house")
    endif()
    check_file(${room})
  else()
    check_file(top)  # lyrefit.h, study.h and fleet.h, the doors to every room
  endif()
endforeach()

list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "no source files under ${ROOT}")
elseif(BROKEN)
  message(FATAL_ERROR "${BROKEN} of the includes in ${count} files break the order of the rooms")
endif()
message(NOTICE "${count} files keep the order of the rooms")
