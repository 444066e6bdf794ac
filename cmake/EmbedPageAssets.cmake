# Writes the assets of pages as a source file: page.css, page.js and, if it is installed, Plotly, compressed.
#   cmake -DFOLDER=<assets> -DPLOTLY=<plotly-basic.min.js or nothing> -DOUT=<page_assets.cc> -P EmbedPageAssets.cmake
cmake_minimum_required(VERSION 3.25)

# Appends a function that returns the bytes of a file.
function(embed function file)
  file(READ "${file}" bytes HEX)
  if(file MATCHES "\\.gz$")  # without the time of the build, so that equal files give equal bytes
    string(SUBSTRING "${bytes}" 0 8 before)
    string(SUBSTRING "${bytes}" 16 -1 after)
    set(bytes "${before}00000000${after}")
  endif()
  string(LENGTH "${bytes}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(..)" "\\\\x\\1" bytes "${bytes}")
  string(REPEAT "." 132 line)
  string(REGEX REPLACE "(${line})" "\\1\"\n\"" bytes "${bytes}")
  file(APPEND "${OUT}.new" "std::string_view ${function}() {\n  return {\"${bytes}\", ${size}};\n}\n\n")
endfunction()

file(WRITE "${OUT}.new" "// Written by cmake/EmbedPageAssets.cmake.\n#include \"lyrefit/report/page_assets.h\"\n\nnamespace lyrefit {\n\n")
embed(PageStyle "${FOLDER}/page.css")
embed(PageScript "${FOLDER}/page.js")
if(PLOTLY)
  get_filename_component(folder "${PLOTLY}" DIRECTORY)
  file(ARCHIVE_CREATE OUTPUT "${OUT}.gz" PATHS "${PLOTLY}" FORMAT raw COMPRESSION GZip
       COMPRESSION_LEVEL 9)
  embed(PackedPlotly "${OUT}.gz")
  embed(PlotlyLicence "${folder}/LICENSE")
else()
  file(APPEND "${OUT}.new" "std::string_view PackedPlotly() { return {}; }\n\nstd::string_view PlotlyLicence() { return {}; }\n\n")
endif()
file(APPEND "${OUT}.new" "}  // namespace lyrefit\n")
file(RENAME "${OUT}.new" "${OUT}")
