#pragma once

// The door to many curves: lyrefit::fleet. Reads them one by one from a plant's folder or a table,
// writes a row of each, and the page of a plant.

#include "lyrefit/fleet/fleet_source.h"
#include "lyrefit/fleet/result_row.h"
