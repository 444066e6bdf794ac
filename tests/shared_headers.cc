// Only there for the precompiled header to belong to a target.
#include "shared_headers.h"
