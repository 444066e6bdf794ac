#if defined(__x86_64__)
#define LYREFIT_KERNEL avx2
#define LYREFIT_KERNEL_NAME "avx2"
#define LYREFIT_KERNEL_WIDTH 4
#include "lyrefit/model/kernel_impl.h"
#endif
