#define LYREFIT_KERNEL portable
#define LYREFIT_KERNEL_NAME "portable"
#define LYREFIT_KERNEL_WIDTH 2
#include "lyrefit/device/kernel_impl.h"
