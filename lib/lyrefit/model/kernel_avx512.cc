#if defined(__x86_64__)
#define LYREFIT_KERNEL avx512
#define LYREFIT_KERNEL_NAME "avx512"
#define LYREFIT_KERNEL_WIDTH 8
#include "lyrefit/model/kernel_impl.h"
#endif
