# Where lyrefit is published, the only place that says it; empty: nowhere yet. The others follow from the first, and each may
# be set to another address, or to "" where there is none. After a change: cmake/address.py --write.
set(LYREFIT_ADDRESS "")
set(LYREFIT_SOURCE "${LYREFIT_ADDRESS}.git")
set(LYREFIT_SITE "${LYREFIT_ADDRESS}/site")
set(LYREFIT_RELEASES "${LYREFIT_ADDRESS}/releases")
set(LYREFIT_TRACKER "${LYREFIT_ADDRESS}/issues")

foreach(what ADDRESS SOURCE SITE RELEASES TRACKER)
  if(LYREFIT_ADDRESS STREQUAL "")
    set(LYREFIT_${what} "")
  endif()
  if(CMAKE_SCRIPT_MODE_FILE)  # cmake -P, for cmake/address.py
    message("${what}=${LYREFIT_${what}}")
  endif()
endforeach()
