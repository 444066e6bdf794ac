# The target `site`: the pages of apps/site in build/site. It needs the command, the Python module, the reference pages and
# what cmake/setup.sh installs for the purpose `site`. Its tests are in tests/site.
set(missing)
if(NOT TARGET reference)
  list(APPEND missing "doxygen")
endif()
if(NOT LYREFIT_BUILD_APP OR NOT LYREFIT_BUILD_PYTHON)
  list(APPEND missing "the command or the Python module")
else()
  foreach(module sphinx sphinx_gallery sphinx_rtd_theme sphinx_copybutton myst_parser nbsphinx nbclient ipykernel matplotlib pandas)
    execute_process(COMMAND "${LYREFIT_PYTHON}" -c "import importlib.util, sys; sys.exit(not importlib.util.find_spec('${module}'))"
                    RESULT_VARIABLE absent)
    if(absent)
      list(APPEND missing "${module}")
    endif()
  endforeach()
endif()
if(missing)
  list(JOIN missing ", " LYREFIT_SITE_MISSING)
  message(STATUS "No site: ${LYREFIT_SITE_MISSING} missing")
  return()
endif()

set(LYREFIT_SITE_DIR "${PROJECT_BINARY_DIR}/site")
set(LYREFIT_PAGE "${PROJECT_SOURCE_DIR}/build-web/apps/web/lyrefit.html" CACHE FILEPATH
    "The page that needs no server, which the site takes in if it is there (cmake/web.sh makes it)")
add_custom_target(site
  COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${LYREFIT_PYTHON_PATH}"
          "${LYREFIT_PYTHON}" -B "${PROJECT_SOURCE_DIR}/apps/site/build.py" --command $<TARGET_FILE:lyrefit_app>
          --reference "${LYREFIT_REFERENCE_DIR}" --parts "${PROJECT_BINARY_DIR}/site_parts"
          --page "${LYREFIT_PAGE}" --out "${LYREFIT_SITE_DIR}"
  COMMENT "Site" VERBATIM)
add_dependencies(site lyrefit_app lyrefit_python lyrefit_python_package reference)
