# Proves that the vector kernels keep their code to themselves. A function that such an object shared with
# the rest (an inline one, say) would be compiled for the newer processor, the linker could keep that copy
# for everybody, and the command would die on older processors.
#   cmake -DOBJECTS="kernel_avx2.cc.o|..." -DNM=nm -P kernel_symbols.cmake
cmake_minimum_required(VERSION 3.25)
string(REPLACE "|" ";" OBJECTS "${OBJECTS}")

set(SHARED 0)
set(SEEN)
foreach(object IN LISTS OBJECTS)
  if(NOT object MATCHES "(kernel|string)_(avx[0-9]+)\\.cc\\.o(bj)?$")
    message(FATAL_ERROR "${object} is not named like a vector kernel")
  endif()
  set(isa "${CMAKE_MATCH_2}")
  execute_process(COMMAND ${NM} --demangle --defined-only "${object}"
                  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "," listing "${listing}")
  string(REGEX MATCHALL "[^\n]+" lines "${listing}")
  foreach(line IN LISTS lines)
    # Upper case, u (unique) and i (resolved at start-up) are visible outside the object; lower case is its
    # own. A constructor of static data is local too but runs on every processor before main().
    if(line MATCHES "^[0-9a-f]+ ([A-Zuiwv]) (.*)$")
      set(name "${CMAKE_MATCH_2}")
      if(name MATCHES "lyrefit::${isa}::k(String)?Kernel$")
        list(APPEND SEEN ${isa})
      elseif(NOT name MATCHES "lyrefit::${isa}::")
        message(NOTICE "${object}: ${name} is shared with the other objects")
        math(EXPR SHARED "${SHARED} + 1")
      endif()
    elseif(line MATCHES "_GLOBAL__|global constructors")
      message(NOTICE "${object}: runs code before main()")
      math(EXPR SHARED "${SHARED} + 1")
    endif()
  endforeach()
  if(NOT isa IN_LIST SEEN AND NOT SHARED)
    message(FATAL_ERROR "${object} defines no kernel of lyrefit::${isa}: nothing was checked")
  endif()
endforeach()

if(NOT SEEN AND NOT SHARED)
  message(FATAL_ERROR "no vector kernel was given")
elseif(SHARED)
  message(FATAL_ERROR "${SHARED} symbols compiled for newer processors only can reach the others")
endif()
