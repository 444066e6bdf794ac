# Debian packages, built by `cmake/packages.sh`. The target package_parts builds their contents that an ordinary build
# lacks, and `cpack` writes
#   liblyrefitX.Y      the shared library; its name has the interface version, as Debian's policy requires
#   liblyrefit-dev     headers, static archive, package files of CMake and pkg-config, schemas
#   lyrefit            the command on the shared library, its manual and completion, lyrefit-slurm
#   python3-lyrefit    the Python module, if it is built
# Equal sources give equal bytes: the packages' time stamp is SOURCE_DATE_EPOCH.
set(LYREFIT_SHARED_PACKAGE "liblyrefit${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lyrefit)
set(LYREFIT_MAINTAINER "the lyrefit authors <lyrefit@example.org>" CACHE STRING "Who stands for the packages")
set(CPACK_PACKAGE_CONTACT "${LYREFIT_MAINTAINER}")
if(LYREFIT_ADDRESS)
  set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${LYREFIT_ADDRESS}")
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL runtime dev command)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 0)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${LYREFIT_SHARED_PACKAGE})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/triggers")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # these name the package that users of the library depend on
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "diode models fitted to photovoltaic I-V curves (library)
lyrefit finds the parameters of one-, two- and three-diode models in measured
current-voltage curves of solar cells, modules and strings, says how certain
they are, and diagnoses what the model gets wrong.

This is the shared library.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME liblyrefit-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${LYREFIT_SHARED_PACKAGE} (= ${PROJECT_VERSION}), libexpected-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS
    "libceres-dev, libcsv-dev, libfmt-dev, libgoogle-glog-dev, zlib1g-dev, pkgconf, cmake")
set(CPACK_DEBIAN_DEV_DESCRIPTION "diode models fitted to photovoltaic I-V curves (development)
lyrefit finds the parameters of one-, two- and three-diode models in measured
current-voltage curves of solar cells, modules and strings, says how certain
they are, and diagnoses what the model gets wrong.

These are the headers of the C++17 library, the files of CMake and pkg-config,
the schemas of the JSON that it writes, and a static archive; only to link
that one are the suggested packages needed.")

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME lyrefit)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib/whole")
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "${LYREFIT_SHARED_PACKAGE} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "gnuplot-nox")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "slurm-wlm, parallel, python3-distributed")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "diode models fitted to photovoltaic I-V curves (command)
lyrefit finds the parameters of one-, two- and three-diode models in measured
current-voltage curves of solar cells, modules and strings, says how certain
they are, and diagnoses what the model gets wrong. Files of many tracers are
read as they are; answers are text, JSON, CSV and pages of HTML, with pictures
where gnuplot is installed.

This is the command, with its manual and the completion of bash and zsh, and
lyrefit-slurm, which spreads many curves over a cluster.")

if(TARGET lyrefit_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lyrefit)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  string(REGEX REPLACE "^3[.]" "" next_python "${LYREFIT_PYTHON_VERSION}")
  math(EXPR next_python "${next_python} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${LYREFIT_SHARED_PACKAGE} (= ${PROJECT_VERSION}), python3 (>= \
${LYREFIT_PYTHON_VERSION}~), python3 (<< 3.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas")
  # The Python module linked to the shared library.
  find_package(fmt REQUIRED)
  find_package(glog REQUIRED)
  add_library(lyrefit_module MODULE EXCLUDE_FROM_ALL "${LYREFIT_WITHOUT_PAGMO}" $<TARGET_OBJECTS:lyrefit_python>)
  set_target_properties(lyrefit_module PROPERTIES PREFIX "" OUTPUT_NAME _lyrefit SUFFIX "${LYREFIT_PYTHON_SUFFIX}"
                        LINKER_LANGUAGE CXX LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/packages/python")
  target_link_libraries(lyrefit_module PRIVATE lyrefit_shared fmt::fmt glog::glog)
  target_link_options(lyrefit_module PRIVATE -Wl,--as-needed)
  install(TARGETS lyrefit_module LIBRARY DESTINATION "${LYREFIT_PYTHON_DIR}/lyrefit" COMPONENT python EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "diode models fitted to photovoltaic I-V curves (Python 3)
lyrefit finds the parameters of one-, two- and three-diode models in measured
current-voltage curves of solar cells, modules and strings, says how certain
they are, and diagnoses what the model gets wrong.

This is the Python module: NumPy arrays and pandas frames in, the same digits
as the command's out, under the names that pvlib has.")
endif()

# Files of a Debian package beyond the installed ones: licences, changelog, manual and completion. The command itself
# prints its manual and its completion.
set(parts "${PROJECT_BINARY_DIR}/packages/parts")
string(TIMESTAMP CHANGED "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" LICENSE_TEXT)
string(REGEX REPLACE "^.*All rights reserved.\n\n" "" LICENSE_TEXT "${LICENSE_TEXT}")
string(REGEX REPLACE "\n+$" "" LICENSE_TEXT "${LICENSE_TEXT}")
string(REPLACE "\n" "\n " LICENSE_TEXT " ${LICENSE_TEXT}")
string(REGEX REPLACE "\n \n" "\n .\n" LICENSE_TEXT "${LICENSE_TEXT}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/debian/copyright.in" "${parts}/copyright" @ONLY)
configure_file("${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in" "${parts}/changelog" @ONLY)
set(compress gzip -9 -n -c)
add_custom_command(OUTPUT "${parts}/lyrefit.1.gz" "${parts}/lyrefit.bash" "${parts}/_lyrefit"
  COMMAND lyrefit_command man > "${parts}/lyrefit.1"
  COMMAND ${compress} "${parts}/lyrefit.1" > "${parts}/lyrefit.1.gz"
  COMMAND lyrefit_command completion bash > "${parts}/lyrefit.bash"
  COMMAND lyrefit_command completion zsh > "${parts}/_lyrefit"
  DEPENDS lyrefit_command VERBATIM)
add_custom_command(OUTPUT "${parts}/changelog.gz" "${parts}/lyrefit-slurm.1.gz"
  COMMAND ${compress} "${parts}/changelog" > "${parts}/changelog.gz"
  COMMAND ${compress} "${PROJECT_SOURCE_DIR}/apps/slurm/lyrefit-slurm.1" > "${parts}/lyrefit-slurm.1.gz"
  DEPENDS "${parts}/changelog" "${PROJECT_SOURCE_DIR}/apps/slurm/lyrefit-slurm.1" VERBATIM)
set(all)
if(LYREFIT_BUILD_TESTS AND LYREFIT_ALL_TESTS)  # tests check the contents of packages
  set(all ALL)
endif()
add_custom_target(package_parts ${all} DEPENDS lyrefit_shared lyrefit_static lyrefit_command
                  "${parts}/lyrefit.1.gz" "${parts}/changelog.gz")

if(TARGET lyrefit_module)
  add_dependencies(package_parts lyrefit_module lyrefit_python_stubs)
endif()

install(TARGETS lyrefit_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command EXCLUDE_FROM_ALL)
function(lyrefit_package_file component file folder)
  install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_DATADIR}/${folder}" COMPONENT ${component} EXCLUDE_FROM_ALL
          ${ARGN})
endfunction()
lyrefit_package_file(command "${parts}/lyrefit.1.gz" man/man1)
lyrefit_package_file(command "${parts}/lyrefit-slurm.1.gz" man/man1)
lyrefit_package_file(command "${parts}/lyrefit.bash" bash-completion/completions RENAME lyrefit)
lyrefit_package_file(command "${parts}/_lyrefit" zsh/vendor-completions)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER "CPACK_DEBIAN_${component}_PACKAGE_NAME" name)
  lyrefit_package_file(${component} "${parts}/copyright" doc/${${name}})
  lyrefit_package_file(${component} "${parts}/changelog.gz" doc/${${name}})
endforeach()
# lyrefit-slurm finds its parts through this link's target.
file(CREATE_LINK ../share/lyrefit/slurm/lyrefit-slurm "${parts}/lyrefit-slurm" SYMBOLIC)
install(FILES "${parts}/lyrefit-slurm" DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command EXCLUDE_FROM_ALL)

include(CPack)
