# What the shared library shows: names that a public header says, installed or of the command's own part in it (apps/plant),
# nothing of the closed ones and nothing of the libraries inside.
#   cmake -DLIBRARY=<liblyrefit.so> -DHEADERS=<installed include folder> -DPLANT=<apps/plant> -DNM=<nm> -P symbols.cmake
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE headers "${HEADERS}/lyrefit/*.h")
file(GLOB own "${PLANT}/*.h")
foreach(header IN LISTS own)
  file(STRINGS "${header}" shown REGEX "^namespace LYREFIT_PUBLIC ")
  if(shown)
    list(APPEND headers "${header}")
  endif()
endforeach()
set(said)
foreach(header IN LISTS headers)
  file(READ "${header}" text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")  # comments name much
  string(REGEX MATCHALL "[A-Za-z_][A-Za-z_0-9]*" names "${text}")
  list(APPEND said ${names})
endforeach()
list(REMOVE_DUPLICATES said)
foreach(name IN LISTS said)
  set("SAID_${name}" ON)
endforeach()

execute_process(COMMAND ${NM} -DC --defined-only "${LIBRARY}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "," symbols "${symbols}")  # which mean something to a list
string(REGEX MATCHALL "[0-9a-f]+ [A-Za-z] [^\n]+" symbols "${symbols}")
set(closed)
foreach(symbol IN LISTS symbols)
  string(REGEX REPLACE "^[0-9a-f]+ [A-Za-z] ((vtable|typeinfo|typeinfo name|guard variable) for )?" "" name "${symbol}")
  string(REGEX REPLACE "^lyrefit::([A-Za-z_0-9]+).*$" "\\1" name "${name}")
  if(NOT DEFINED "SAID_${name}")
    list(APPEND closed "${symbol}")
  endif()
endforeach()
list(LENGTH symbols shown)
list(LENGTH closed hidden)
message(NOTICE "the shared library shows ${shown} names, ${hidden} of which no public header says")
if(closed OR shown LESS 100)  # so few cannot be all that public headers declare
  list(JOIN closed "\n  " closed)
  message(FATAL_ERROR "shown, and not public:\n  ${closed}")
endif()
