// This file only gives the precompiled header a target.
#include "shared_headers.h"
