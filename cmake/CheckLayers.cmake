# Test of the module order. A module includes only modules that it is allowed to. The command includes only installed
# headers. The shared library exports exactly the installed headers. No two headers define types of one name, because a
# linker would then keep one destructor for both.
#   cmake -DROOT=<folder with lib/ and apps/> -P CheckLayers.cmake
# Lists every violation and fails if there is one.
cmake_minimum_required(VERSION 3.25)

# folder -> the modules of lib/lyrefit, or their folders, that its files may include, besides itself
set(ALLOWED_base)
set(ALLOWED_read base)
set(ALLOWED_model base read)
set(ALLOWED_model/effects base read model)  # independent of fitting
set(ALLOWED_search base)  # independent of photovoltaics
set(ALLOWED_estimate/refine base read model)
set(ALLOWED_estimate/fit base read model model/effects search estimate/refine)
set(ALLOWED_estimate/family base read model model/effects search estimate/refine estimate/fit)
set(ALLOWED_estimate/cell base read model estimate/refine estimate/fit)
set(ALLOWED_certify base read model estimate/refine estimate/fit)
set(ALLOWED_diagnose base read model model/effects search estimate certify)
set(ALLOWED_translate base read model model/effects estimate/fit estimate/family diagnose)
set(ALLOWED_trend base read model estimate)
# Computes nothing.
set(ALLOWED_report base read model search estimate/fit estimate/family estimate/cell certify diagnose translate
    trend)
# A separate library with its own writers in study/report. The core's writers do not depend on it.
set(ALLOWED_study base read model model/effects search estimate certify report)
# A separate library for many curves, their rows and their page.
set(ALLOWED_batch base read model model/effects estimate/fit estimate/family estimate/cell certify diagnose
    translate trend report)
set(FOLDERS base read model model/effects search estimate/refine estimate/fit estimate/family estimate/cell certify
    diagnose translate trend report study batch)
# A folder that is named in FOLDERS, or the module: that of "study/report/plots.h" is study.
set(IN_FOLDER "^lyrefit/(model/effects|estimate/[^/]+|[^/]+)/")

set(PUBLIC)  # the installed headers
if(EXISTS "${ROOT}/cmake/LyrefitInstall.cmake")
  file(STRINGS "${ROOT}/cmake/LyrefitInstall.cmake" PUBLIC REGEX "^  [a-z_/]+\\.h\\)?$")
  list(TRANSFORM PUBLIC REPLACE "[ )]" "")
endif()

set(BROKEN 0)
macro(complain text)
  message(NOTICE "${FILE}: ${text}")
  math(EXPR BROKEN "${BROKEN} + 1")
endmacro()

# Checks an include in lib/; `quoted` is the text between the quotation marks.
function(check_own_include module quoted)
  if(NOT quoted MATCHES "^lyrefit/(.+)$")
    complain("includes \"${quoted}\"; inside lib/ includes start with \"lyrefit/\"")
  elseif(quoted MATCHES "${IN_FOLDER}")
    set(other "${CMAKE_MATCH_1}")
    string(REGEX REPLACE "/.*" "" whole "${other}")
    if(whole STREQUAL "model")  # the terms do not know the effects
      set(whole "${other}")
    endif()
    if(NOT other STREQUAL module AND NOT other IN_LIST ALLOWED_${module} AND NOT whole IN_LIST ALLOWED_${module})
      complain("module ${module} must not include module ${other} (\"${quoted}\")")
    endif()
  else()
    complain("module ${module} must not include \"${quoted}\", which includes every module")
  endif()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

# Checks an include in apps/. Allowed are the headers listed in LyrefitInstall.cmake, and base/try.h for its macro.
function(check_public_include header)
  if(header MATCHES "^lyrefit/(.+)$" AND PUBLIC AND NOT header STREQUAL "lyrefit/base/try.h"
     AND NOT CMAKE_MATCH_1 IN_LIST PUBLIC)
    complain("the command must not include the closed header \"${header}\"")
  endif()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

function(check_file module)
  file(STRINGS "${ROOT}/${FILE}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)[>\"]")
      continue()
    endif()
    set(mark "${CMAKE_MATCH_1}")
    set(header "${CMAKE_MATCH_2}")
    if(header MATCHES "^ceres/" AND NOT FILE MATCHES "/refine/(solve|least_squares)\\.cc$")
      complain("only estimate/refine/solve.cc and estimate/refine/least_squares.cc include Ceres (<${header}>)")
    endif()
    if(module STREQUAL "apps")
      check_public_include("${header}")
      continue()
    endif()
    if(header STREQUAL "iostream")
      complain("the library prints nothing (<iostream>)")
    elseif(header MATCHES "^CLI/")
      complain("the library must build without the app's dependencies (<${header}>)")
    endif()
    if(FILE STREQUAL "lib/lyrefit/lyrefit.h" AND header MATCHES "^lyrefit/(study|batch)[/.]")
      complain("the core knows nothing of the studies and of batches (\"${header}\")")
    endif()
    if(module IN_LIST FOLDERS AND (mark STREQUAL "\"" OR header MATCHES "^lyrefit/"))
      check_own_include(${module} "${header}")
    endif()
  endforeach()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

# Checks that no other header defines a type of the same name in the same namespace. Nested types are not checked.
function(check_types)
  set(namespace lyrefit)
  file(STRINGS "${ROOT}/${FILE}" lines REGEX "^(namespace (LYREFIT_PUBLIC )?[a-z]|}  // namespace|struct |class |enum class )")
  foreach(line IN LISTS lines)
    if(line MATCHES "^namespace (LYREFIT_PUBLIC )?([a-z_:]+)")
      set(namespace "${CMAKE_MATCH_2}")
    elseif(line MATCHES "^}")
      set(namespace lyrefit)
    elseif(line MATCHES "^(struct|class|enum class) ([A-Za-z0-9]+) [{:f]")
      set(type "${namespace}::${CMAKE_MATCH_2}")
      if(DEFINED "HOME_${type}")
        complain("${type} is the name of another type in ${HOME_${type}}")
      else()
        set("HOME_${type}" "${FILE}")
        set("HOME_${type}" "${FILE}" PARENT_SCOPE)
      endif()
    endif()
  endforeach()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

# Checks that the public headers, and no others, open their namespace with LYREFIT_PUBLIC, which exports their
# declarations from the shared library.
function(check_shown)
  string(REGEX REPLACE "^lib/lyrefit/" "" header "${FILE}")
  file(STRINGS "${ROOT}/${FILE}" opened REGEX "^namespace .*lyrefit {")
  foreach(line IN LISTS opened)
    if(header IN_LIST PUBLIC AND NOT line MATCHES "LYREFIT_PUBLIC")
      complain("is public: its namespace opens with `namespace LYREFIT_PUBLIC lyrefit {`")
    elseif(NOT header IN_LIST PUBLIC AND line MATCHES "LYREFIT_PUBLIC")
      complain("is closed: LYREFIT_PUBLIC is for the headers that are installed")
    endif()
  endforeach()
  set(BROKEN ${BROKEN} PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/lib/*.h" "${ROOT}/lib/*.cc"
     "${ROOT}/apps/*.h" "${ROOT}/apps/*.cc")
foreach(FILE IN LISTS files)
  if(FILE MATCHES "[.]h$")
    check_types()
  endif()
  if(PUBLIC AND FILE MATCHES "^lib/")
    check_shown()
  endif()
  if(FILE MATCHES "^apps/")
    check_file(apps)
  elseif(FILE MATCHES "^lib/lyrefit/(model/effects|estimate/[^/]+|[^/]+)/")
    set(module "${CMAKE_MATCH_1}")
    if(NOT module IN_LIST FOLDERS)
      complain("lib/lyrefit/${module} is no module of the library")
    endif()
    check_file(${module})
  else()
    check_file(top)  # lyrefit.h, study.h and batch.h, which include every module
  endif()
endforeach()

list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "no source files under ${ROOT}")
elseif(BROKEN)
  message(FATAL_ERROR "${BROKEN} remarks: ${count} files do not keep the order of the layers")
endif()
message(NOTICE "${count} files keep the order of the layers")
