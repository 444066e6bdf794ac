# Flags of every target. No contraction of a * b + c: the same seed must give the same bits with and
# without fused multiply-add.
add_compile_options(-Wall -Wextra -Wshadow -ffp-contract=off)
if(LYREFIT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Eigen changes its own allocation under the address sanitizer; libraries built without it, which hand
  # matrices over, do not.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
