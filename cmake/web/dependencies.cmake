# The libraries that lyrefit is built on, for WebAssembly: what find_package would find on the machine is made here,
# of Debian's sources in LYREFIT_WEB_SOURCES (cmake/web.sh fetches them) and of the headers that its packages install.
#   cmake -DCMAKE_TOOLCHAIN_FILE=<Emscripten.cmake> -DCMAKE_PROJECT_TOP_LEVEL_INCLUDES=cmake/web/dependencies.cmake
#         -DLYREFIT_WEB_SOURCES=<folder> ...
# Eigen takes two numbers at a time by SSE2, and so adds in the order in which it adds on the machines of the native
# build; the compiler writes SSE2 as WebAssembly's own vectors. It has no header of the older MMX, of which Eigen
# asks for the name alone, and no assembler of x86, which Eigen uses for compilers that say they are GCC before 6.3
# or after 5.
add_compile_options(-msimd128 -msse2 -fgnuc-version=5.99.0)
if(NOT EXISTS "${CMAKE_BINARY_DIR}/headers/mmintrin.h")  # written anew, it would have all compiled anew
  file(WRITE "${CMAKE_BINARY_DIR}/headers/mmintrin.h" "")
endif()
include_directories(SYSTEM "${CMAKE_BINARY_DIR}/headers")
# The linker's scripts need the module acorn, which Debian installs where only its own Node.js looks.
set_property(GLOBAL PROPERTY RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
# Files of the machine, as native builds find them, lie outside the other system.
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
# Node's fetch() does not read files, which is where a program that is no page finds its own.
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)

# The one folder of LYREFIT_WEB_SOURCES whose name begins with `package`-.
function(web_source package variable)
  file(GLOB folder "${LYREFIT_WEB_SOURCES}/${package}-[0-9]*")
  list(FILTER folder EXCLUDE REGEX "\\.(dsc|xz|gz|bz2)$")
  list(LENGTH folder count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${LYREFIT_WEB_SOURCES} holds no source of ${package}, or several; cmake/web.sh fetches it")
  endif()
  set(${variable} "${folder}" PARENT_SCOPE)
endfunction()

# A library of other people's sources: its warnings are theirs.
function(web_library name include)
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${ARGN})
  target_include_directories(${name} SYSTEM PUBLIC ${include})
  target_compile_options(${name} PRIVATE -w $<$<CONFIG:Release>:-O2>)
  # Most of the time goes into headers that neighbours share.
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
endfunction()

# The target of that name which find_package would give.
function(web_package name)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(${name} INTERFACE ${ARGN})
endfunction()

# Headers of the machine that hold no code of its processor. /usr/include as a whole would hide the C library of the
# other system, so links to what is wanted stand in a folder of their own.
function(web_headers name)
  foreach(header IN LISTS ARGN)
    if(NOT EXISTS "/usr/include/${header}")
      message(FATAL_ERROR "/usr/include/${header} is missing; cmake/web.sh installs its package")
    endif()
    file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/headers")
    file(CREATE_LINK "/usr/include/${header}" "${CMAKE_BINARY_DIR}/headers/${header}" SYMBOLIC)
  endforeach()
  add_library(${name} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${name} SYSTEM INTERFACE "${CMAKE_BINARY_DIR}/headers")
endfunction()

function(web_ceres)
  web_source(ceres-solver root)
  set(folder "${root}/internal/ceres")
  file(GLOB sources "${folder}/*.cc")
  list(FILTER sources EXCLUDE REGEX "(_test|_test_utils?|_benchmark|/test_util|_main|/gmock_[a-z_]+|/evaluator_test_utils|parallel_for_(cxx|openmp)|thread_pool)\\.cc$")
  list(FILTER sources EXCLUDE REGEX "/(numeric_diff_test_utils|c_api|covariance|covariance_impl|gradient_problem|gradient_problem_solver|normal_prior|conditioned_cost_function)\\.cc$")
  list(APPEND sources "${folder}/generated/partitioned_matrix_view_d_d_d.cc"
       "${folder}/generated/schur_eliminator_d_d_d.cc" "${folder}/miniglog/glog/logging.cc")
  web_library(ceres "${root}/include;${root}/config;${folder}/miniglog" ${sources})
  target_include_directories(ceres PRIVATE "${root}/internal")
  target_compile_definitions(ceres PUBLIC CERES_NO_SUITESPARSE CERES_NO_CXSPARSE CERES_NO_ACCELERATE_SPARSE
    CERES_NO_LAPACK CERES_NO_CUDA CERES_NO_THREADS CERES_RESTRICT_SCHUR_SPECIALIZATION "CERES_EXPORT=" "CERES_NO_EXPORT="
    MAX_LOG_LEVEL=-2)  # its small log writes everything that it is not told to leave out; -2 are errors
  target_link_libraries(ceres PUBLIC Eigen3::Eigen)
  web_package(Ceres::ceres ceres)
  web_package(glog::glog ceres)  # Ceres' own small one
endfunction()

function(web_zlib)
  web_source(zlib root)
  file(GLOB sources "${root}/*.c")
  web_library(zlib "${root}" ${sources})
  set_target_properties(zlib PROPERTIES UNITY_BUILD OFF)
  web_package(ZLIB::ZLIB zlib)
endfunction()

function(web_fmt)
  web_source(fmtlib root)
  web_library(fmt "${root}/include" "${root}/src/format.cc")
  web_package(fmt::fmt fmt)
endfunction()

function(web_csv)
  web_source(libcsv root)
  web_library(csv "${root}" "${root}/libcsv.c")
  web_package(LibCsv::csv csv)
endfunction()

function(web_googletest)
  set(root /usr/src/googletest)
  web_library(gtest "${root}/googletest/include" "${root}/googletest/src/gtest-all.cc")
  web_library(gmock "${root}/googlemock/include" "${root}/googlemock/src/gmock-all.cc")
  web_library(gtest_main "" "${root}/googletest/src/gtest_main.cc")
  target_include_directories(gtest PRIVATE "${root}/googletest")
  target_include_directories(gmock PRIVATE "${root}/googlemock")
  target_link_libraries(gmock PUBLIC gtest)
  target_link_libraries(gtest_main PUBLIC gtest)
  foreach(name gtest gmock gtest_main)
    web_package(GTest::${name} ${name})
  endforeach()
endfunction()

# find_package comes here first. What is not named is not there.
macro(web_provide method package)
  set(${package}_FOUND TRUE)
  if("${package}" STREQUAL "Eigen3")
    if(NOT TARGET Eigen3::Eigen)
      add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
      target_include_directories(Eigen3::Eigen SYSTEM INTERFACE /usr/include/eigen3)
    endif()
  elseif("${package}" STREQUAL "Threads")  # none, nor processes
    if(NOT TARGET Threads::Threads)
      web_library(no_processes "" "${PROJECT_SOURCE_DIR}/cmake/web/no_processes.c")
      web_package(Threads::Threads no_processes)
    endif()
  elseif("${package}" STREQUAL "Ceres")
    if(NOT TARGET Ceres::ceres)
      web_ceres()
    endif()
  elseif("${package}" STREQUAL "glog")
    find_package(Ceres REQUIRED)
  elseif("${package}" STREQUAL "fmt")
    if(NOT TARGET fmt::fmt)
      web_fmt()
    endif()
  elseif("${package}" STREQUAL "LibCsv")
    if(NOT TARGET LibCsv::csv)
      web_csv()
    endif()
  elseif("${package}" STREQUAL "ZLIB")
    if(NOT TARGET ZLIB::ZLIB)
      web_zlib()
    endif()
  elseif("${package}" STREQUAL "GTest")
    if(NOT TARGET GTest::gtest)
      web_googletest()
    endif()
  elseif("${package}" STREQUAL "Boost")
    if(NOT TARGET Boost::boost)
      web_headers(Boost::boost boost)
    endif()
  elseif("${package}" STREQUAL "nlohmann_json")
    if(NOT TARGET nlohmann_json::nlohmann_json)
      web_headers(nlohmann_json::nlohmann_json nlohmann)
    endif()
  elseif("${package}" STREQUAL "tl-expected")
    if(NOT TARGET tl::expected)
      web_headers(tl::expected tl)
    endif()
  else()
    set(${package}_FOUND FALSE)
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER web_provide SUPPORTED_METHODS FIND_PACKAGE)
enable_language(C)  # libcsv and zlib; not before the provider is set
