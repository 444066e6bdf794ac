#define LYREFIT_KERNEL portable
#define LYREFIT_KERNEL_NAME "portable"
#define LYREFIT_KERNEL_WIDTH 2
#include "lyrefit/model/kernel_impl.h"
