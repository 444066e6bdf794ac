# Writes the style and the scripts of a plant's page as a source file. The scripts are joined in the order of the list.
#   cmake "-DSCRIPTS=a.js|b.js" -DSTYLE=plant.css -DOUT=plant_assets.cc -P EmbedPlantAssets.cmake
cmake_minimum_required(VERSION 3.25)

set(SOURCE "// Written by cmake/EmbedPlantAssets.cmake.\n#include \"lyrefit/batch/plant_assets.h\"\n\nnamespace lyrefit {\n")
# Appends a function that returns the texts of the files one after the other.
function(embed function)
  set(text "")
  foreach(file IN LISTS ARGN)
    file(READ "${file}" bytes HEX)
    string(APPEND text "${bytes}")
  endforeach()
  string(REGEX REPLACE "(..)" "\\\\x\\1" text "${text}")
  string(REGEX REPLACE "((\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..))" "\\1\"\n\"" text "${text}")
  set(SOURCE "${SOURCE}\nstd::string_view ${function}() {\n  return\n\"${text}\";\n}\n" PARENT_SCOPE)
endfunction()
string(REPLACE "|" ";" SCRIPTS "${SCRIPTS}")
embed(PlantStyle "${STYLE}")
embed(PlantScript ${SCRIPTS})
file(WRITE "${OUT}" "${SOURCE}\n}  // namespace lyrefit\n")
