#if defined(__x86_64__)
#define LYREFIT_KERNEL avx512
#define LYREFIT_KERNEL_NAME "avx512"
#define LYREFIT_KERNEL_WIDTH 8
#include "lyrefit/law/kernel_impl.h"
#endif
