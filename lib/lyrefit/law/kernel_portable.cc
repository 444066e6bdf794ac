#define LYREFIT_KERNEL portable
#define LYREFIT_KERNEL_NAME "portable"
#define LYREFIT_KERNEL_WIDTH 2
#include "lyrefit/law/kernel_impl.h"
