# Installation by `cmake --install`: the public headers, the library, the command (by its own folder) and the package
# for find_package(lyrefit).
include(CMakePackageConfigHelpers)
set(LYREFIT_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/lyrefit")

# The public headers of all modules, which the modules name (lib/CMakeLists.txt), and those that include them. A header that
# a public header includes must be public too. The test `package` compiles each one alone from the installed tree, which
# lacks the internal headers. Those in data/stable/promised.txt stay as they are within a major version; the first line of the
# others says that they are experimental. Component `core` has those of the core alone.
set(LYREFIT_PUBLIC_HEADERS "${PROJECT_SOURCE_DIR}/lib/lyrefit/lyrefit.h" "${PROJECT_SOURCE_DIR}/lib/lyrefit/study.h"
                           "${PROJECT_SOURCE_DIR}/lib/lyrefit/batch.h")
set(LYREFIT_CORE_HEADERS "${PROJECT_SOURCE_DIR}/lib/lyrefit/core.h")
foreach(module IN LISTS LYREFIT_MODULES)
  get_property(headers GLOBAL PROPERTY LYREFIT_HEADERS_${module})
  if(module IN_LIST LYREFIT_CORE)
    list(APPEND LYREFIT_CORE_HEADERS ${headers})
  else()
    list(APPEND LYREFIT_PUBLIC_HEADERS ${headers})
  endif()
endforeach()
foreach(part core whole)
  add_library(lyrefit_${part}_headers INTERFACE)
endforeach()
target_sources(lyrefit_core_headers INTERFACE FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/lib" FILES ${LYREFIT_CORE_HEADERS})
list(APPEND LYREFIT_PUBLIC_HEADERS ${LYREFIT_CORE_HEADERS})
target_sources(lyrefit_whole_headers INTERFACE FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/lib" FILES ${LYREFIT_PUBLIC_HEADERS})
install(TARGETS lyrefit_whole_headers FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
install(TARGETS lyrefit_core_headers FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT core EXCLUDE_FROM_ALL)

# Components of packages: `runtime` is the shared library, `dev` the files for compiling, `command` the program on the
# shared library (LyrefitPackages.cmake). `cmake --install` without a component installs the library type that
# BUILD_SHARED_LIBS selects. The other type is built and installed if its component is requested.
foreach(kind static shared)
  if(NOT TARGET lyrefit_${kind})
    continue()
  endif()
  set(by_default)
  if((kind STREQUAL "shared" AND NOT BUILD_SHARED_LIBS) OR (kind STREQUAL "static" AND BUILD_SHARED_LIBS))
    set(by_default EXCLUDE_FROM_ALL)
    set_target_properties(lyrefit_${kind} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  install(TARGETS lyrefit_${kind} EXPORT lyrefit-${kind}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev ${by_default}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev ${by_default})
  install(EXPORT lyrefit-${kind} NAMESPACE lyrefit:: FILE lyrefit-${kind}-targets.cmake
          DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT dev ${by_default})
endforeach()

# The core alone: an archive, its headers and the files of find_package. It is laid down on request.
install(TARGETS lyrefit_core_static EXPORT lyrefit-core ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT core EXCLUDE_FROM_ALL)
install(EXPORT lyrefit-core NAMESPACE lyrefit:: FILE lyrefit-core-targets.cmake
        DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT core EXCLUDE_FROM_ALL)

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/lyrefit-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
                              INSTALL_DESTINATION ${LYREFIT_PACKAGE_DIR})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit-config.cmake"
              "${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/FindLibCsv.cmake"
        DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT dev)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit-config.cmake" "${PROJECT_BINARY_DIR}/lyrefit-config-version.cmake"
        DESTINATION ${LYREFIT_PACKAGE_DIR} COMPONENT core EXCLUDE_FROM_ALL)
# Requires.private is omitted, because pkg-config would then require the dependencies' files even for the shared
# library. The file of pkg-config states its prefix relative to itself, so that an installed tree may be moved.
file(RELATIVE_PATH LYREFIT_PREFIX_FROM_PC "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file("${PROJECT_SOURCE_DIR}/cmake/lyrefit.pc.in" "${PROJECT_BINARY_DIR}/lyrefit.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/lyrefit.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
# Schemas of the JSON records.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/schema" DESTINATION ${CMAKE_INSTALL_DATADIR}/lyrefit COMPONENT dev
        FILES_MATCHING PATTERN "*.json")
