# Flags of every target. No contraction of a * b + c: the same seed must give the same bits with and
# without fused multiply-add.
add_compile_options(-Wall -Wextra -Wshadow -ffp-contract=off)
# The same sources give the same bytes wherever they lie: what is checked is named by its place in the tree.
add_compile_options("$<$<CONFIG:Release>:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>")
if(LYREFIT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(LYREFIT_SANITIZED)
  # The headers of the system are checked by their own assertions: the sanitizers' checks in Eigen's and the
  # standard library's templates are two thirds of the code and find what an assertion says better.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    add_compile_options(-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitize.ignore)
  endif()
  # Eigen changes its own allocation under the address sanitizer; libraries built without it, which hand
  # matrices over, do not.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# A compiler cache where there is one, shared by all checkouts: paths inside the project count as relative.
find_program(LYREFIT_CCACHE ccache)
mark_as_advanced(LYREFIT_CCACHE)
if(LYREFIT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}"
      CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${LYREFIT_CCACHE})
endif()
