# Flags of every target. -ffp-contract=off forbids contraction of a * b + c: equal seeds must give equal bits with and
# without fused multiply-add.
add_compile_options(-Wall -Wextra -Wshadow -ffp-contract=off)
# GCC collects its garbage less often: a tenth to a quarter of the time to compile, for a few hundred megabytes.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-expand=400" "SHELL:--param ggc-min-heapsize=2000000")
endif()
# Equal sources give equal bytes in any folder: assertions name files relative to the project.
add_compile_options("$<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>")
if(LYREFIT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(LYREFIT_SANITIZED)
  # System headers are checked by their own assertions instead of sanitizers. Sanitizer checks in the templates of Eigen
  # and the standard library would be two thirds of the code, and assertions report their errors better.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    add_compile_options(-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitize.ignore)
  endif()
  # Eigen changes its allocation under the address sanitizer. Libraries built without the sanitizer, which pass matrices
  # to lyrefit, do not.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Uses a compiler cache if there is one. Checkouts share it, since paths inside the project count as relative.
find_program(LYREFIT_CCACHE ccache)
mark_as_advanced(LYREFIT_CCACHE)
if(LYREFIT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
      CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${LYREFIT_CCACHE})
endif()
