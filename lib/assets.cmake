# Assets embedded in pages. cmake/setup.sh installs the parts by others; without them pages show static pictures and
# tables. Only pages of the native build have tables of many rows.
set(LYREFIT_PARTS "${PROJECT_BINARY_DIR}/page_parts/node_modules")
find_file(LYREFIT_PLOTLY plotly-basic.min.js NO_DEFAULT_PATH HINTS "${LYREFIT_PARTS}/plotly.js-basic-dist-min"
          DOC "Plotly's basic bundle, minified, for pages")
find_file(LYREFIT_TABULATOR tabulator.min.js NO_DEFAULT_PATH HINTS "${LYREFIT_PARTS}/tabulator-tables/dist/js"
          DOC "Tabulator, minified, for tables of many rows")
if(NOT LYREFIT_PLOTLY OR NOT LYREFIT_TABULATOR)
  message(STATUS "Plotly or Tabulator is not installed (npm ci of cmake/page_parts): pages will show pictures and tables that stand still")
endif()
set(LYREFIT_PAGE_ASSETS "${CMAKE_CURRENT_SOURCE_DIR}/lyrefit/report/assets")
set(files PageStyle=${LYREFIT_PAGE_ASSETS}/page.css PageScript=${LYREFIT_PAGE_ASSETS}/page.js
          TableScript=${LYREFIT_PAGE_ASSETS}/table.js)
if(LYREFIT_PLOTLY)
  get_filename_component(folder "${LYREFIT_PLOTLY}" DIRECTORY)
  list(APPEND files "PackedPlotly=${LYREFIT_PLOTLY}" "PlotlyLicence=${folder}/LICENSE")
else()
  list(APPEND files PackedPlotly= PlotlyLicence=)
endif()
if(LYREFIT_TABULATOR AND NOT EMSCRIPTEN)
  get_filename_component(folder "${LYREFIT_TABULATOR}/../../.." ABSOLUTE)
  list(APPEND files "PackedTabulator=${LYREFIT_TABULATOR}"
                    "PackedTabulatorStyle=${folder}/dist/css/tabulator_simple.min.css"
                    "TabulatorLicence=${folder}/LICENSE")
else()
  list(APPEND files PackedTabulator= PackedTabulatorStyle= TabulatorLicence=)
endif()
string(REGEX REPLACE "[A-Za-z]+=" "" depends "${files}")
string(REPLACE "," ";" depends "${depends}")
list(REMOVE_ITEM depends "")
list(JOIN files "|" files)
set(LYREFIT_ASSET_SOURCE "${CMAKE_CURRENT_BINARY_DIR}/assets/page_assets.cc")
add_custom_command(OUTPUT "${LYREFIT_ASSET_SOURCE}"
  COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DHEADER=lyrefit/report/page_shell.h "-DOUT=${LYREFIT_ASSET_SOURCE}"
          -P "${PROJECT_SOURCE_DIR}/cmake/EmbedAssets.cmake"
  DEPENDS ${depends} "${PROJECT_SOURCE_DIR}/cmake/EmbedAssets.cmake"
  COMMENT "Embedding what pages need" VERBATIM)
set_source_files_properties("${LYREFIT_ASSET_SOURCE}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # not linted
